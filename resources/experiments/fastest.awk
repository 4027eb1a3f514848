# How often the robot that went for the ball was the fastest, from the rows of who_is_fastest.toml:
#   awk -f resources/experiments/fastest.awk fastest/results.csv
# Within the noise: not slower than the fastest by more than two standard errors of both means over the copies, or 0.15 s.
BEGIN { FS = "," }
NR == 1 {
    for (i = 1; i <= NF; i++) column[$i] = i
    names = "trial variant end measure.time_s feature.chosen"
    for (i = 2; i <= 4; i++) names = names " feature.at_" i " feature.believed_" i " feature.by_" i
    split(names, needed, " ")
    for (i in needed) if (!(needed[i] in column)) { print "fastest.awk: no column " needed[i] > "/dev/stderr"; wrong = 1; exit 1 }
    next
}
$column["end"] != "no branch" {
    t = $column["trial"]; v = $column["variant"]; x = $column["measure.time_s"]
    chosen[t] = $column["feature.chosen"] + 0
    for (i = 1; i <= 3; i++) {
        at[t, i] = $column["feature.at_" i + 1] + 0
        believed[t, i] = $column["feature.believed_" i + 1] + 0
        by[t, i] = cost($column["feature.by_" i + 1])
    }
    n[t, v]++; d = x - mean[t, v]; mean[t, v] += d / n[t, v]; square[t, v] += d * (x - mean[t, v])
}
function cost(text) { return text == "inf" ? 1e9 : text + 0 } # inf: it does not know the ball
function least(values, t,    best, i) {
    best = 1
    for (i = 2; i <= 3; i++) if (values[t, i] < values[t, best]) best = i
    return best
}
function judge(line, t, k,    b, slower, noise) {
    b = least(mean, t)
    slower = mean[t, k] - mean[t, b]
    noise = 2 * sqrt((square[t, k] + square[t, b]) / (n[t, k] - 1) / n[t, k])
    all[line]++; first[line] += slower < 0.15; near[line] += slower <= (noise > 0.15 ? noise : 0.15); sum[line] += slower
}
function print_line(line,    p, z, centre, half) {
    if (all[line] == 0) return
    p = near[line] / all[line]; z = 1.96 ^ 2 / all[line]
    centre = (p + z / 2) / (1 + z); half = sqrt(z * (p * (1 - p) + z / 4)) / (1 + z)
    printf "%-58s %4d  fastest %3.0f %%, within the noise %.1f %% (%.1f-%.1f), slower by %.1f s on average\n",
        line, all[line], 100 * first[line] / all[line], 100 * p, 100 * (centre - half), 100 * (centre + half), sum[line] / all[line]
}
END {
    if (wrong) exit 1
    for (t in chosen) {
        judge("all moments", t, chosen[t])
        if (at[t, least(at, t)] < 0.6) continue
        judge("none of the team is at the ball: who went", t, chosen[t])
        judge("none of the team is at the ball: least learned time", t, least(by, t))
        judge("none of the team is at the ball: nearest, as they believe", t, least(believed, t))
        judge("none of the team is at the ball: nearest", t, least(at, t))
    }
    print_line("all moments")
    print_line("none of the team is at the ball: who went")
    print_line("none of the team is at the ball: least learned time")
    print_line("none of the team is at the ball: nearest, as they believe")
    print_line("none of the team is at the ball: nearest")
}
