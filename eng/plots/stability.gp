# What docs/stability.md states, as curves: docs/benchmarks/stability.csv and stability-soak.csv → SVG beside them.
# From the root: gnuplot eng/plots/stability.gp     (Debian: gnuplot-nox)
folder = 'docs/benchmarks/'
quick = folder.'stability.csv'
soak = folder.'stability-soak.csv'
set datafile separator ','
set datafile commentschars '#'
set datafile missing NaN
set encoding utf8
set grid lw 0.5 lc rgb '#dddddd'
set border 3 lc rgb '#666666'
set tics nomirror
unset mxtics
unset mytics
set key noautotitle
set logscale xy
set format x '10^{%T}'
set format y '10^{%T}'
array C[6] = ['#1b6ca8', '#d1495b', '#2e8b57', '#b8860b', '#7b4fa3', '#444444']
font = "font 'DejaVu Sans,13' background rgb 'white'"

# Columns: test, what, at, cases, worst, promised. Rows without a place on the curve are those of whole tests.
worst(what) = strcol(2) eq what && strcol(3) ne '' ? column(5) : NaN
promised(what) = strcol(2) eq what && strcol(3) ne '' ? column(6) : NaN
of(name) = strstrt(strcol(1), '('.name.')') > 0

eval "set terminal svg size 1000,420 ".font
set output folder.'stability-kernel.svg'
set multiplot layout 1,2 title 'Distance from a triangle: largest error, as a part of the magnitude'
set yrange [1e-17:1e-10]
set xrange [3:3e-17]
set xtics ('1' 1, '10^{-4}' 1e-4, '10^{-8}' 1e-8, '10^{-12}' 1e-12, '10^{-16}' 1e-16)
set xlabel 'sine of the smallest angle'
set ylabel 'error'
set key top left Left reverse samplen 2
thin = 'distance by the sine of the smallest angle (of the magnitude)'
plot quick using 3:(promised(thin)) with lines dt 2 lw 1.5 lc rgb C[6] title 'promised', \
     soak using 3:(worst(thin)) with linespoints lw 1 pt 6 ps 0.6 lc rgb C[2] title 'soak', \
     quick using 3:(worst(thin)) with linespoints lw 2 pt 7 ps 0.4 lc rgb C[1] title 'quick'
set xrange [0.5:2e12]
set xtics 1,1e3
set xlabel 'distance from the origin, sizes of the face'
unset ylabel
far = 'distance by the offset in sizes (of the magnitude)'
plot quick using 3:(promised(far)) with lines dt 2 lw 1.5 lc rgb C[6] title 'promised', \
     soak using 3:(worst(far)) with linespoints lw 1 pt 6 ps 0.6 lc rgb C[2] title 'soak', \
     quick using 3:(worst(far)) with linespoints lw 2 pt 7 ps 0.4 lc rgb C[1] title 'quick'
unset multiplot

eval "set terminal svg size 800,420 ".font
set output folder.'stability-inverse.svg'
set title 'Inverse of a matrix: largest error, as a part of the largest entry'
set xrange [0.5:2e16]
set xtics 1,1e2
set yrange [1e-17:1e3]
set ytics 1e-16,1e4
set xlabel 'condition'
set ylabel 'error'
inverse = 'inverse by the condition (relative error)'
plot quick using 3:(promised(inverse)) smooth unique with lines dt 2 lw 1.5 lc rgb C[6] title 'promised: 8 × condition × 2^{−52}', \
     quick using 3:(worst(inverse)) smooth unique with linespoints lw 2 pt 7 ps 0.4 lc rgb C[1] title 'measured'
set ytics autofreq

eval "set terminal svg size 1000,460 ".font
set output folder.'stability-colliders.svg'
unset title
set bmargin 6
set multiplot layout 1,3 title 'Distance from a placed object: largest error, as a part of the magnitude'
array S[4] = ['mesh', 'similar fractal', 'skewed fractal', 'fractal of sums']
set key bmargin center maxrows 2 samplen 1.5 width 1
set yrange [3e-17:3e-12]
set xlabel offset 0,0.4
do for [panel=1:3] {
    by = word('translation scale condition', panel)
    what = 'distance by the '.(panel == 1 ? 'translation in sizes' : by).' (of the magnitude): '
    set xlabel panel == 1 ? 'moved by … sizes' : by
    if (panel == 1) { set ylabel 'error'; set xrange [0.5:2e9]; set xtics 1,1e3 } else { unset ylabel }
    if (panel == 2) { set xrange [3e-13:3e12]; set xtics 1e-12,1e6 }
    if (panel == 3) { set xrange [0.7:1.5e6]; set xtics 1,1e2 }
    named = panel == 2
    plot quick using 3:(promised(what.S[1])) with lines dt 2 lw 1.5 lc rgb C[6] title (named ? 'promised' : ''), \
         NaN with linespoints lw 1 pt 6 ps 0.6 lc rgb C[6] title (named ? 'soak' : ''), \
         for [i=1:4] soak using 3:(worst(what.S[i])) with linespoints lw 1 pt 6 ps 0.5 lc rgb C[i], \
         for [i=1:4] quick using 3:(worst(what.S[i])) with linespoints lw 2 pt 7 ps 0.3 lc rgb C[i] title (named ? S[i] : '')
}
unset multiplot
set bmargin
set xlabel offset 0,0
set key inside bottom right Left reverse samplen 2 maxrows 5 width 0

eval "set terminal svg size 800,420 ".font
set output folder.'stability-zoom.svg'
set title 'Into a fractal and back: how far the camera is from where it began, as a part of the distance'
set xrange [0.7:1.5e6]
set xtics 1,10
set yrange [1e-17:1e-8]
set xlabel 'levels'
set ylabel 'error'
back = 'place after the return by depth (of the distance)'
array F[3] = ['menger', 'sierpinski', 'turned']
plot soak using 3:(of('menger') ? promised(back) : NaN) with lines dt 2 lw 1.5 lc rgb C[6] title 'promised', \
     NaN with linespoints lw 1 pt 6 ps 0.6 lc rgb C[6] title 'soak', \
     for [i=1:3] soak using 3:(of(F[i]) ? worst(back) : NaN) with linespoints lw 1 pt 6 ps 0.6 lc rgb C[i], \
     for [i=1:3] quick using 3:(of(F[i]) ? worst(back) : NaN) with linespoints lw 2 pt 7 ps 0.4 lc rgb C[i] title F[i]

set output folder.'stability-depth-buffer.svg'
set title 'Two surfaces behind each other: smallest gap that keeps their order, as a part of the distance'
set xrange [0.7:1.5e7]
set yrange [1e-8:3e-6]
set key bottom left
set xlabel 'distance, in distances of the near plane'
set ylabel 'gap'
gap = 'smallest gap that keeps its order by distance (of the distance)'
plot quick using 3:(of('10000000') ? promised(gap) : NaN) with lines dt 2 lw 1.5 lc rgb C[6] title 'promised', \
     quick using 3:(of('10000000') ? worst(gap) : NaN) with linespoints lw 2 pt 6 ps 0.8 lc rgb C[1] title 'far plane at 10^7'

set output folder.'stability-energy.svg'
set title 'A ball that bounces without loss: largest change of its energy, as a part of it'
set xrange [0.7:1.5e6]
set yrange [3e-17:1e-6]
set xlabel 'steps'
set ylabel 'change'
set key top left maxrows 4
energy = 'energy of a ball that bounces with e = 1 by steps (of the first)'
array H[6] = ['1E-05', '0.0001', '0.001', '0.004166666666666667', '0.016666666666666666', '0.1']
array T[6] = ['0.01 ms', '0.1 ms', '1 ms', '1/240 s', '1/60 s', '0.1 s']
plot NaN with lines dt 2 lw 1 lc rgb C[6] title 'promised', \
     NaN with linespoints lw 1 pt 6 ps 0.6 lc rgb C[6] title 'soak', \
     for [i=1:6] soak using 3:(of(H[i]) ? promised(energy) : NaN) with lines dt 2 lw 1 lc rgb C[i], \
     for [i=1:6] soak using 3:(of(H[i]) ? worst(energy) : NaN) with linespoints lw 1 pt 6 ps 0.6 lc rgb C[i], \
     for [i=1:6] quick using 3:(of(H[i]) ? worst(energy) : NaN) with linespoints lw 2 pt 7 ps 0.4 lc rgb C[i] title 'steps of '.T[i]
