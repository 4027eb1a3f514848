-- A log laid over its simulation: the rollout that is farthest off, where it leaves the log and why, or how far off it ends. Pictures are made in
-- the current folder; ./demo runs this where there is no display.
--   mrose-gui --offscreen --script resources/scripts/real_log.lua --log MRCLAM_Dataset6
expect(reality("windows") > 0, "rollouts are compared")
worst(1)
select(reality("robot"))
layer_uncertainty(true)
if reality("divergence") then go_to_divergence() else seek(9.9) end
screenshot("reality.png")
if reality("session") ~= "" then say("trajectory", reality("session"), "of the log:") end
say("the simulated", reality("robot"), "from", reality("start"), "s on is off by", floor(1000 * reality("error") + 0.5) / 10, "cm on average")
if reality("divergence") then
    say("leaves the logged trajectory after", reality("divergence"), "s; likely cause:", reality("cause"))
    if reality("explained") then
        say("the best of the re-runs explains", floor(100 * reality("explained") + 0.5), "% of it")
    end
else
    say("stays within what such robots differ from themselves")
end
