# Shares of the time in which none, one or more go for the ball, and for how long one goes, from the rows of who_goes.toml:
#   awk -f goes_for.awk who_goes/results.csv
BEGIN { FS = "," }
function plain(line,    text) { # without the commas of quoted fields
    while (match(line, /"[^"]*"/)) {
        text = substr(line, RSTART + 1, RLENGTH - 2); gsub(/,/, ";", text)
        line = substr(line, 1, RSTART - 1) text substr(line, RSTART + RLENGTH)
    }
    return line
}
{ $0 = plain($0) }
NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next }
{
    v = $c["variant_name"]; if (!(v in n)) names[++count] = v
    n[v]++; none[v] += $c["measure.none_percent"]; one[v] += $c["measure.one_percent"]; more[v] += $c["measure.more_percent"]
    gone[v] += $c["measure.gone_s"]; begun[v] += $c["measure.begun"]
}
END {
    printf "%-34s  none %%   one %%  more %%  goes for, s\n", "chosen by"
    for (i = 1; i <= count; i++) {
        v = names[i]
        printf "%-34s  %6.2f  %6.2f  %6.2f  %11.1f\n", v, none[v] / n[v], one[v] / n[v], more[v] / n[v], gone[v] / begun[v]
    }
}
