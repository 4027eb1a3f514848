# Goals of the team that chooses by the learned time and of the other one, a game, from the rows of p_against_nearest.toml:
#   awk -f resources/experiments/goals_gained.awk matches/results.csv
# Each trial is played both ways: the difference is that of their mean, with its 95 % interval over trials.
BEGIN { FS = "," }
NR == 1 {
    for (i = 1; i <= NF; i++) column[$i] = i
    split("trial variant_name measure.red measure.blue", needed, " ")
    for (i in needed) if (!(needed[i] in column)) { print "goals_gained.awk: no column " needed[i] > "/dev/stderr"; wrong = 1; exit 1 }
    next
}
{
    red = $column["variant_name"] ~ /^"?red/; t = $column["trial"]
    own = $column[red ? "measure.red" : "measure.blue"]; other = $column[red ? "measure.blue" : "measure.red"]
    games++; scored += own; conceded += other; gain[t] += own - other; played[t]++
}
END {
    if (wrong) exit 1
    for (t in gain) { d = gain[t] / played[t]; n++; e = d - mean; mean += e / n; square += e * (d - mean) }
    printf "%d games: %.3f goals a game to %.3f, %+.3f +- %.3f\n", games, scored / games, conceded / games, mean, 1.96 * sqrt(square / (n - 1) / n)
}
