# What each optimisation saves, and what frames cost: docs/benchmarks/skips.csv, frames.csv → SVG beside them.
# From the root: gnuplot eng/plots/drawing.gp     (Debian: gnuplot-nox)
folder = 'docs/benchmarks/'
set datafile separator ','
set datafile commentschars '#'
set datafile missing NaN
set border 3 lc rgb '#666666'
set tics nomirror
set grid lw 0.5 lc rgb '#dddddd'
array C[4] = ['#d1495b', '#1b6ca8', '#2e8b57', '#b8860b']

# Ratios to the row with all optimisations, one position for each that is disabled.
ratios(scene) = "< awk -F, -v scene=".scene." '!/^#/ && $1 == scene { if ($2 == \"nothing\") { for (i = 3; i <= 6; i++) first[i] = $i } else { printf \"%s,%d\", $2, ++n; \
for (i = 3; i <= 6; i++) printf \",%s\", $i / first[i]; print \"\" } }' ".folder."skips.csv"
scenes = 'gallery textured crowd'

set terminal svg size 1000,460 font 'DejaVu Sans,13' background rgb 'white'
set output folder.'skips.svg'
set multiplot layout 1,3 title 'Each optimisation disabled alone, relative to all enabled'
set logscale y
set yrange [0.7:60]
set ytics ('1' 1, '2' 2, '5' 5, '10' 10, '20' 20, '50' 50)
set xrange [0.4:11.6]
set xtics rotate by 60 right font ',11'
set bmargin 8
set lmargin 8
set rmargin 1
do for [scene in scenes] {
    set title scene eq 'crowd' ? '400 objects of four files' : scene.'.sdo'
    set ylabel scene eq 'gallery' ? 'times as much' : ''
    if (scene eq 'textured') { set key top left Left reverse samplen 1 } else { unset key }
    plot ratios(scene) using ($2-0.21):5:xtic(1) with impulses lw 5 lc rgb C[2] title 'still frame', \
         '' using ($2-0.07):4 with impulses lw 5 lc rgb C[1] title 'moving frame', \
         '' using ($2+0.07):3 with impulses lw 5 lc rgb C[3] title 'start', \
         '' using ($2+0.21):6 with impulses lw 5 lc rgb C[4] title 'allocated at start', \
         1 with lines lc rgb '#444444' notitle
}
unset multiplot
unset lmargin
unset rmargin

# A row for each view: every instance where all fit, the visible ones, and a frame like the one before.
frames(drawn) = "< awk -F, -v drawn='".drawn."' '!/^#/ && $1 != \"picture\" { if (!($1 in place)) { place[$1] = ++n } if ($2 == drawn) printf \"%s,%d,%s\\n\", $1, place[$1], $4 }' ".folder."frames.csv"
set terminal svg size 1000,460 font 'DejaVu Sans,13' background rgb 'white'
set output folder.'frames.svg'
set title 'Time of a frame of 1280 × 720'
unset xrange
set xtics rotate by 20 right font ',11'
set bmargin 6
set ylabel 'ms'
set yrange [1:30000]
set ytics ('1' 1, '10' 10, '100' 100, '1,000' 1000, '10,000' 10000)
set offsets 0.5, 0.5, 0, 0
set rmargin at screen 0.97
set key outside top center horizontal Left reverse samplen 1 maxrows 1
plot frames('every instance') using 2:3 with points pt 5 ps 1.2 lc rgb C[1] title 'every instance', \
     frames('detail') using 2:3:xtic(1) with points pt 7 ps 1.2 lc rgb C[2] title 'visible instances', \
     frames('- occlusion-culling') using 2:3 with points pt 8 ps 1 lc rgb C[3] title 'without occlusion culling', \
     frames('kept') using 2:3 with points pt 9 ps 1 lc rgb C[4] title 'unchanged view'
