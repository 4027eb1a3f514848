-- A way through the window: which command led to the first kick of the game, and what if it had been another one?
--   mrose-gui --script resources/scripts/soccer_tour.lua
-- With a display it can be watched; with --offscreen it only checks what it expects.
open("soccer.toml")

-- Up to the first kick, by whomever.
local kicked = "(function() for i = 1, #robot do if robot[i].kicked then return true end end return false end)()"
expect(run_until(kicked, 30), "a robot kicks within 30 s")
local kick = tick

-- Back to the decision behind it.
cause_of_kick()
expect(selected ~= "", "the robot that kicked is selected")
expect(tick < kick, "it decided before it kicked")
say(selected .. " decided at " .. time .. " s to kick at tick " .. kick)

-- Another place for it at that moment begins a branch; the run stays as it was.
local decided, name = tick, selected
local x, y = robot[name].x, robot[name].y
drag(name, x + 0.3, y + 0.3)
expect(branches == 2 and branch ~= "the run", "a branch begins")
expect(robot[name].x == x + 0.3, "the robot stands where it was dropped")

-- Both go on, side by side.
side_by_side(true)
seek_tick(kick + 100)
expect(tick == kick + 100)
local there = robot[name].x
other_branch()
expect(branch == "the run", "the other branch is the run")
expect(robot[name].x ~= there, "it went another way")

-- Undone, all is as before.
side_by_side(false)
seek_tick(decided)
expect(robot[name].x == x and robot[name].y == y, "the run is what it was")
