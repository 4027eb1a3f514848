-- The pictures of the window in the README: make_window.sh runs this in the folder where they are to be.
open("soccer.toml")

-- A branch: "red 2" starts its way behind the ball elsewhere; what it did before stays as a ghost.
seek(2)
select("red 2")
layer_grid(false)
drag("red 2", robot["red 2"].x - 0.4, robot["red 2"].y + 0.5)
plot("red 2", "speed")
plot("red 2", "command_v")
seek(5)
screenshot("window.png")
dark(true)
screenshot("window_dark.png")
expect(branches == 2 and selected == "red 2")
