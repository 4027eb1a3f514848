-- The paper's figures 3a to 3c: a robot approaches a ball at the wall, stops before it, and turns fast towards the field's centre; and
-- what comes of it. All four show the same part of the field. Pictures are made in the current folder; repeat runs this where the window is built.
--   mrose-gui --offscreen ball_off_the_wall.toml --trial 17 --script figure3.lua
to_start()
layer_grid(false)
select("player")
expect(run_until("robot[1].controller.state == 'aligning'", 30), "it approaches the ball")
local approaching = time + 1.5
expect(run_until("robot[1].controller.state == 'turning to it'", 30), "it stops before the ball")
seek(time + 0.5)
follow(true)
zoom_in(6)
follow(false)
screenshot("figure3b.png", "field")
local stopped = time
seek(approaching)
screenshot("figure3a.png", "field")
seek(stopped)
expect(run_until("robot[1].controller.state == 'striking'", 30), "it turns fast")
seek(time + 0.8)
screenshot("figure3c.png", "field")
expect(run_until("robot[1].controller.state == 'free'", 30), "the ball comes free")
screenshot("figure3d.png", "field")
