# How cost grows: docs/benchmarks/growth-*.csv and drawing.csv → SVG beside them.
# From the root: gnuplot eng/plots/growth.gp     (Debian: gnuplot-nox)
folder = 'docs/benchmarks/'
set datafile separator ','
set datafile commentschars '#'
set grid lw 0.5 lc rgb '#dddddd'
set datafile missing NaN
set border 3 lc rgb '#666666'
set tics nomirror
set key noautotitle
array C[6] = ['#1b6ca8', '#d1495b', '#2e8b57', '#b8860b', '#7b4fa3', '#444444']
array N[6] = ['menger', 'sierpinski', 'tree', 'terrain', 'tetrahedron', 'fern']

set terminal svg size 1000,480 font 'DejaVu Sans,13' background rgb 'white'
set output folder.'growth-depth.svg'
set bmargin 6
set multiplot layout 1,2 title 'A query near the surface, by depth'
set xlabel 'depth'
set logscale y
set yrange [0.2:500]
set xrange [0:62]
set ylabel 'µs a query'
set key bmargin center maxrows 2 samplen 1.5 width 1
set xlabel offset 0,0.4
set title 'exact'
plot for [i=1:6] folder.'growth-depth.csv' using 2:(strcol(1) eq N[i] ? $5 : NaN) with linespoints lw 2 pt 7 ps 0.4 lc rgb C[i] title N[i]
set title 'the paper’s descent'
plot for [i=1:6] folder.'growth-depth.csv' using 2:(strcol(1) eq N[i] ? $6 : NaN) with linespoints lw 2 pt 7 ps 0.4 lc rgb C[i] title N[i]
unset multiplot
set key noautotitle inside
set bmargin
set xlabel offset 0,0

set terminal svg size 800,480 font 'DejaVu Sans,13' background rgb 'white'
set output folder.'growth-faces.svg'
set title 'A query near the surface, by the faces of a mesh'
set logscale xy
set xrange [0.8:150000]
set yrange [0.05:100000]
set format x '10^{%T}'
set format y '10^{%T}'
set xlabel 'faces of the mesh (terrain: full lines; icosphere: dashed)'
set key inside top left Left reverse maxrows 4
array L[4] = ['fractal over it (7⁵ copies), the paper’s descent', 'mesh alone, every face', 'fractal over it (7⁵ copies), exact', 'mesh alone, hierarchy']
array F[4] = [4, 6, 3, 5]
plot for [i=1:4] folder.'growth-faces.csv' using 2:(strcol(1) eq 'terrain' ? column(F[i]) : NaN) with linespoints lw 2 pt 7 ps 0.5 lc rgb C[i] title L[i], \
     for [i=1:4] folder.'growth-faces.csv' using 2:(strcol(1) eq 'icosphere' ? column(F[i]) : NaN) with linespoints lw 1.5 dt 2 pt 6 ps 0.5 lc rgb C[i]

set output folder.'drawing.svg'
set title 'A frame of the Menger sponge from afar, 1280 × 720, depth 1 to 5'
set xrange [150:60000000]
set yrange [1:*]
set xlabel 'faces of the fractal'
set ylabel 'ms a frame'
set key inside top left Left reverse maxrows 2
plot folder.'drawing.csv' using 3:(strcol(4) eq 'all' ? $6 : NaN) with linespoints lw 2 pt 7 ps 0.5 lc rgb C[2] title 'every instance drawn', \
     folder.'drawing.csv' using 3:(strcol(4) eq 'culled' ? $6 : NaN) with linespoints lw 2 pt 7 ps 0.5 lc rgb C[1] title 'visible instances drawn'
