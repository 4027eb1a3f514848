-- The README's picture of a real log over its simulation: make_window.sh runs this where MROSE_DATA names the folder of the logs.
add_model("create_paper.net")
worst(1)  -- the one that is shown already would not be scrolled to
worst(11)
select(reality("robot"))
show_inspector(false)
layer_uncertainty(true)
seek(9.9)
screenshot("reality.png")
