-- A B21 finds its way among people by what it senses: what it met, and what it did then.
--   mrose-gui --script resources/scripts/corridor_tour.lua
-- With a display it can be watched; with --offscreen it only checks what it expects.
open("b21_corridor.toml")
select("b21")
layer_laser(true)
layer_sonar(true)
layer_infrared(true)
layer_bumpers(true)

-- Where it stands, it knows the walls beside it by its own echoes.
seek(1)
expect(robot.b21.laser.echoes > 50, "the laser meets the corridor")
expect(abs(robot.b21.laser.nearest - 0.65) < 0.15, "its nearest wall is the one at its right")
expect(robot.b21.controller["obstacle points"] > 20, "its controller remembers what they met")

-- Someone comes near, ahead of it: it sees them by its laser, as an echo where no wall is.
local near = "(function() for i = 1, #person do if distance(robot.b21, person[i]) < 1.2 then return true end end return false end)()"
expect(run_until(near, 60), "it meets somebody within a minute")
plot("b21", "speed")
plot("b21", "laser", "nearest")
say("at " .. time .. " s the nearest echo is " .. robot.b21.laser.nearest .. " m away")

-- It goes on, to the corridor's other end.
expect(run_until("robot.b21.x > 8", 110), "it arrives at the east end")
say("it arrived at " .. time .. " s")
expect(run_until("robot.b21.x < 7", 60), "and turns back")

-- Put before a wall it does not run into it: a branch, and the run stays as it was.
local turned = tick
drag("b21", 5.2, -0.7, 0)
expect(branches == 2, "a branch begins")
expect(not run_until("touching(robot.b21, wall)", 4), "it keeps off the photocopier")
other_branch()
seek_tick(turned)
expect(robot.b21.x < 7 and robot.b21.x > 6.9, "the run is what it was")
