# The picture of docs/nature.md: gnuplot -e "rows='nature.csv'; picture='nature.png'" nature.gp
set terminal pngcairo size 2000, 900 font "DejaVu Sans,14" linewidth 1.6
set output picture
set datafile separator ","
set grid ytics lc rgb "#e4e4e4" lt 1 lw 0.8
set border 3 lc rgb "#6b6b6b"
set tics nomirror textcolor rgb "#1a1a1a"
set ylabel "measured over published"
set yrange [0:2]
set key outside top center horizontal samplen 1.5 width 2
set xtics rotate by 40 right font ",11" scale 0
set bmargin 11
set lmargin 18

# Columns: case 1, quantity 3, published 4, uncertainty 5, runtime 8 to 10 (value, error, ratio), full CFD 11 to 13. Rows that have a
# ratio stand side by side.
place = 0
there(x) = strlen(strcol(10)) + strlen(strcol(13)) > 0 && strcol(1) ne "case"
next(x) = there(0) ? (place = place + 1, place) : NaN
band(x) = strlen(strcol(5)) > 0 ? $5 / $4 : 0
error(value, of) = strlen(strcol(of)) > 0 ? value / $4 : 0
set style fill solid 0.35 noborder
set boxwidth 0.8
set arrow 1 from graph 0, first 1 to graph 1, first 1 nohead lc rgb "#1a1a1a" back
plot rows using (next(0)):(1.0):(1 - band(0)):(1 + band(0)):(0.4):xtic(there(0) ? strcol(1) . ": " . strcol(3) : "") skip 1 \
       with boxxyerror lc rgb "#b0b0b0" title "published, with its uncertainty", \
     (place = 0) rows using (next(0) - 0.12):(strlen(strcol(10)) > 0 ? $10 : NaN):(error($9, 9)) skip 1 \
       with yerrorbars lc rgb "#2a6f97" pt 7 ps 1.6 title "runtime", \
     (place = 0) rows using (next(0) + 0.12):(strlen(strcol(13)) > 0 ? $13 : NaN):(error($12, 12)) skip 1 \
       with yerrorbars lc rgb "#d98c1f" pt 5 ps 1.6 title "full CFD"
