-- Pictures of a recorded game, in the current folder: ./demo runs this where there is no display.
--   mrose-gui --offscreen --script recorded_game.lua soccer.mcap
to_end()
screenshot("game.png")

-- A robot at work: what it sees, decides and is commanded.
seek(20)
select("red 2")
plot_expression("robot[2].speed")
plot_expression("ball.speed")
screenshot("robot.png")

-- It stands elsewhere: a branch goes on beside what was recorded.
drag("red 2", robot["red 2"].x - 0.5, robot["red 2"].y + 0.5)
seek(24)
expect(branches == 2, "a branch begins")
screenshot("branch.png")

side_by_side(true)
screenshot("side_by_side.png")
