# Shares of the time in which none, one or more go for the ball, and for how long one goes, from the rows of who_goes.toml:
#   awk -f resources/experiments/goes_for.awk who_goes/results.csv
BEGIN { FS = "," }
function plain(line,    text) { # without the commas of quoted fields
    while (match(line, /"[^"]*"/)) {
        text = substr(line, RSTART + 1, RLENGTH - 2); gsub(/,/, ";", text)
        line = substr(line, 1, RSTART - 1) text substr(line, RSTART + RLENGTH)
    }
    return line
}
{ $0 = plain($0) }
NR == 1 {
    for (i = 1; i <= NF; i++) c[$i] = i
    split("variant_name measure.none_percent measure.one_percent measure.more_percent measure.gone_s measure.begun", needed, " ")
    for (i in needed) if (!(needed[i] in c)) { print "goes_for.awk: no column " needed[i] > "/dev/stderr"; wrong = 1; exit 1 }
    next
}
{
    v = $c["variant_name"]; if (!(v in n)) names[++count] = v
    n[v]++; none[v] += $c["measure.none_percent"]; one[v] += $c["measure.one_percent"]; more[v] += $c["measure.more_percent"]
    gone[v] += $c["measure.gone_s"]; begun[v] += $c["measure.begun"]
}
END {
    if (wrong) exit 1
    printf "%-34s  none %%   one %%  more %%  goes for, s\n", "chosen by"
    for (i = 1; i <= count; i++) {
        v = names[i]
        goes = begun[v] > 0 ? sprintf("%.1f", gone[v] / begun[v]) : "-"
        printf "%-34s  %6.2f  %6.2f  %6.2f  %11s\n", v, none[v] / n[v], one[v] / n[v], more[v] / n[v], goes
    }
}
