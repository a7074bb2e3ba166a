# docs/benchmarks/front.csv: time against error, a plot for each shape. Run in the root of the repository.
set datafile separator comma
set datafile columnheaders
table = "docs/benchmarks/front.csv"
# Shapes without an oracle have no errors.
shapes = system("awk -F, '!/^#/ && $1 != \"shape\" && $10 != \"\" && !seen[$1]++ { print $1 }' ".table)

# Where errors of rounding alone are drawn, and what is one.
floor = 1e-9
rounding = 1e-12

set logscale xy
set xrange [3e-10:3]
set xtics ("exact" floor, "10^{-7}" 1e-7, "10^{-5}" 1e-5, "10^{-3}" 1e-3, "0.1" 0.1)
set ytics ("100 ns" 1e2, "1 µs" 1e3, "10 µs" 1e4, "100 µs" 1e5, "1 ms" 1e6, "10 ms" 1e7)
set yrange [1.5e2:5e7]
set grid xtics ytics lc rgb "#e4e4e4" lt 1
set border 3 lc rgb "#555555"
set tics nomirror scale 0.5
set arrow 1 from floor, graph 0 to floor, graph 1 nohead dt 3 lc rgb "#888888"

is(shape, collider) = strcol("shape") eq shape && strcol("queries") eq "near" && strcol("collider") eq collider
error(column_name) = column(column_name) < rounding ? floor : column(column_name)
x(shape, collider, name) = is(shape, collider) ? error(name) : NaN
# Not all, so that they keep clear of each other.
hasLabel(knob, value) = knob eq "epsilon" ? value > 0 && value != 0.5 : knob eq "depth" ? value == 1 || value == 3 || value > 6 : \
    value == 1 || value == 4 || value == 16 || value == 64
knob(shape, collider) = is(shape, collider) && hasLabel(strcol("knob"), column("value")) ? sprintf("%g", column("value")) : ""
grouped(n) = n < 1e6 ? sprintf("%d,%03d", n / 1000, int(n) % 1000) : sprintf("%d,%03d,%03d", n / 1000000, int(n) / 1000 % 1000, int(n) % 1000)

colliders = "simple octree fractal hierarchy exact"
titles = "'every face' 'octree (depth)' 'descent (width)' 'hierarchy (ε)' 'exact search on levels (ε)'"
array colours[5] = ["#777777", "#d98200", "#c0392b", "#2e8b57", "#2457c5"]
array shapes_of_points[5] = [5, 9, 7, 11, 13]
# Where the knob is written: below left, above right, below, above its point. And where the key is.
array right[5] = [0, -1.4, 1.3, 0, 0]
array up[5] = [0, -0.3, 0.35, -0.8, 0.8]
array key[5] = [0.07, 0.2, 0.37, 0.55, 0.71]
do for [i = 1:5] {
    set label i word(titles, i) at screen key[i], 0.045 point pt shapes_of_points[i] ps 1 lc rgb colours[i] offset 1, 0 tc rgb "#222222"
}

unset key
do for [shape in shapes] {
    set terminal svg size 1040,520 dynamic font "sans,14" background "#ffffff"
    set output "docs/benchmarks/front-".shape.".svg"
    faces = grouped(real(system("awk -F, '$1 == \"".shape."\" { print $2; exit }' ".table)))
    set multiplot title shape.", ".faces." faces: time of a query near the surface, and its error as a part of the shape's size"
    do for [panel = 1:2] {
        name = panel == 1 ? "largest_error" : "mean_error"
        set lmargin at screen panel == 1 ? 0.07 : 0.56
        set rmargin at screen panel == 1 ? 0.48 : 0.97
        set bmargin at screen 0.2
        set tmargin at screen 0.9
        set xlabel panel == 1 ? "largest error" : "mean error"
        plot for [i = 1:5] table using (x(shape, word(colliders, i), name)):(column("query_ns")) \
                with linespoints pt shapes_of_points[i] ps 0.7 lw 1.5 lc rgb colours[i] notitle, \
            for [i = 2:5] table using (x(shape, word(colliders, i), name)):(column("query_ns")):(knob(shape, word(colliders, i))) \
                with labels offset right[i], up[i] font "sans,11" tc rgb colours[i] notitle
    }
    unset multiplot
}
