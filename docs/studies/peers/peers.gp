# The picture of MuJoCo's fluid model beside the reference falls: gnuplot -e "rows='peers.csv'; picture='peers.png'" peers.gp
set terminal pngcairo size 1900, 1150 font "DejaVu Sans,15" linewidth 1.6
set output picture
set datafile separator ","
set border 3 lc rgb "#6b6b6b"
set tics nomirror textcolor rgb "#1a1a1a"
set grid ytics lc rgb "#e4e4e4" lt 1 lw 0.8
set key off

falls = "sphere ellipsoid-tilted ellipsoid-compound ellipsoid-edgewise ellipsoid-heavy spheroid disc-light disc-heavy plate sheet"
models = "'MuJoCo default' 'MuJoCo best' 'MuJoCo best for each shape' 'MuJoCo best for each shape on other falls' 'MuJoCo best for each fall' 'samara by the surface' 'samara by tables with noise'"
names = "'MuJoCo, default' 'MuJoCo, best for all falls' 'MuJoCo, best for the shape' 'MuJoCo, the shape on other falls' 'MuJoCo, best for the fall' 'samara, surface' 'samara, tables'"
array color[7] = ["#9a9a9a", "#c0392b", "#d98c1f", "#7d3c98", "#dcb878", "#3a9d5d", "#2a6f97"]
array mark[7] = [4, 7, 9, 11, 6, 13, 5]
figures = "'descent speed' 'frequency' 'amplitude'"
array limit[3] = [10, 20, 30]

# On two lines.
title(i) = (name = word(falls, i), dash = strstrt(name, "-"), dash ? name[1:dash - 1]."\n".name[dash + 1:*] : name)
# A fall's place, from 1 on; 0 where the word is no fall.
place(name) = (found = 0, sum [i = 1:words(falls)] (name eq word(falls, i) ? i : 0))
# What is beyond the picture stands at its edge.
edge = 105.0
held(x) = x > edge ? edge : x < -edge ? -edge : x

set xrange [0.5:10.5]
set yrange [-112:112]
set ytics ("-100 %%" -100, "-50 %%" -50, "0" 0, "+50 %%" 50, "≥ +100 %%" 105)
set multiplot layout 3, 1 margins 0.075, 0.99, 0.15, 0.965 spacing 0.05
do for [p = 1:3] {
  set title sprintf("%s less that of full CFD (shaded: within %d %%)", word(figures, p), limit[p]) offset 0, -0.6
  set object 1 rectangle from graph 0, first -limit[p] to graph 1, first limit[p] behind fc rgb "#e9f2e6" fs solid noborder
  do for [i = 1:9] { set arrow i from i + 0.5, graph 0 to i + 0.5, graph 1 nohead lc rgb "#dddddd" lw 0.8 }
  if (p == 3) {
    set xtics ("sphere" 1)
    do for [i = 1:words(falls)] { set xtics add (title(i) i) }
    set key at screen 0.5, 0.035 center bottom maxrows 2 Left reverse samplen 1 width -2
  } else {
    unset xtics
  }
  plot for [m = 1:7] rows using \
    (strcol(2) eq word(models, m) && strcol(4 + p) ne "" && (p == 1 || strcol(1) ne "sphere") ? place(strcol(1)) + 0.115 * (m - 4) : NaN): \
    (held(100 * column(4 + p))) with points pt mark[m] ps 1.9 lc rgb color[m] title word(names, m)
}
unset multiplot
