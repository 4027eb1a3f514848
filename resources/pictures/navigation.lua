-- Four robots among four boxes, some way on the paths that they planned.
--   mrose-gui --offscreen planner_choice_validation.toml --trial 3042 --variant 'chosen in simulator' --size 1100x720 --script navigation.lua
to_start()
layer_grid(false)
seek(time + 4)
screenshot("navigation.png", "field")
