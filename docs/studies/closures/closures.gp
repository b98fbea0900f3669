# The picture of the closures: gnuplot -e "rows='closures.csv'; picture='closures.png'" closures.gp
set terminal pngcairo size 2000, 760 font "DejaVu Sans,14" linewidth 1.6
set output picture
set datafile separator ","
set grid xtics ytics lc rgb "#e4e4e4" lt 1 lw 0.8
set border 3 lc rgb "#6b6b6b"
set tics nomirror textcolor rgb "#1a1a1a"

brown_lawler(re) = 24.0 / re * (1 + 0.150 * re ** 0.681) + 0.407 / (1 + 8710.0 / re)
models = "'kEpsilon' 'kOmegaSST linearUpwind' 'kOmegaSSTLM linearUpwind' 'laminar linearUpwind'"
titles = "'k-epsilon, wall functions' 'k-omega SST' 'k-omega SST with transition (LM)' 'no closure'"
array color[4] = ["#c0392b", "#d98c1f", "#2a7f8e", "#7a7a7a"]
array shape[4] = [7, 9, 5, 13]

# Rows of one model; the columns: body 1, Reynolds number 2, model 3, mesh 4, CPU seconds 10, drag 13, literature 18, error 19.
sphere(m, y) = strcol(1) eq "sphere" && strcol(3) eq word(models, m) \
               && (strcol(4) eq "medium" || strcol(4) eq "medium layered" && $2 < 5e4 || strcol(4) eq "medium thinly layered" && $2 > 5e4) ? y : NaN

set multiplot layout 1, 3 margins 0.05, 0.99, 0.21, 0.92 spacing 0.05, 0

set title "sphere: drag against the Reynolds number"
set logscale x
set xrange [30:2e5]
set yrange [0.2:1.8]
set logscale y
set ytics (0.2, 0.3, 0.4, 0.5, 0.7, 1, 1.5)
set xlabel "Re"
set ylabel "C_D"
set key at screen 0.5, 0.015 center bottom maxrows 2 Left reverse width 2 samplen 2
set style fill solid 0.25 noborder
plot '+' using ($1):(0.9 * brown_lawler($1)):(1.1 * brown_lawler($1)) with filledcurves lc rgb "#b0b0b0" title "Brown and Lawler 2003, 10 % to either side", \
     brown_lawler(x) lc rgb "#1a1a1a" notitle, \
     for [m = 1:4] rows using 2:(sphere(m, $13)) with points lc rgb color[m] pt shape[m] ps 1.7 title word(titles, m), \
     NaN with points lc rgb "#5b3a8e" pt 6 ps 1.9 title "in time: DDES, LM, no closure"
set key off

set title "all bodies at Re 1e4: drag over the literature's"
unset logscale
bodies = "sphere cube disc plate 'ellipsoid broadside' 'ellipsoid at 45' 'ellipsoid end on'"
place(name) = sum [i = 1:words(bodies)] (word(bodies, i) eq name ? i : 0)
set xrange [0.5:7.5]
set yrange [0.4:1.6]
set ytics auto
set xlabel ""
set ylabel "C_D over the literature's"
set xtics ("sphere" 1, "cube" 2, "disc" 3, "plate" 4, "ellipsoid\nbroadside" 5, "at 45" 6, "end on" 7)
set arrow 1 from 0.5, 1 to 7.5, 1 nohead lc rgb "#1a1a1a"
plot for [m = 1:4] rows using (place(strcol(1)) + 0.12 * (m - 2.5)):($2 > 9e3 && $2 < 1.2e4 && strcol(3) eq word(models, m) \
     && (strcol(4) eq "medium" || strcol(4) eq "medium layered") && $18 > 0 ? $13 / $18 : NaN) with points lc rgb color[m] pt shape[m] ps 1.7 notitle
unset arrow 1

set title "sphere at Re 1e4: error against cost"
set logscale x
set xrange [1:300]
set xtics auto
set yrange [-0.4:0.4]
set xlabel "CPU seconds of a case"
set ylabel "C_D over the literature's, less 1"
set arrow 1 from 1, 0 to 300, 0 nohead lc rgb "#1a1a1a"
plot for [m = 1:4] rows using 10:($2 == 1e4 && strcol(1) eq "sphere" && strcol(3) eq word(models, m) ? $19 : NaN) \
     with points lc rgb color[m] pt shape[m] ps 1.7 notitle, \
     rows using 10:($2 == 1e4 && strcol(1) eq "sphere" && strstrt(strcol(3), "unsteady") == 1 ? $19 : NaN) with points lc rgb "#5b3a8e" pt 6 ps 1.9 notitle, \
     rows using 10:($2 == 1e4 && strcol(1) eq "sphere" && strcol(3) eq "kOmegaSSTDDES" ? $19 : NaN) with points lc rgb "#5b3a8e" pt 6 ps 1.9 notitle
unset multiplot
