#:project ../FractalEngine.Core/FractalEngine.Core.csproj
#:property PublishAot=false
// Casts exact rays at a Menger sponge of 10^53 faces: what a camera sees of it, and what lies in the shadow.
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;

var maps = from x in Enumerable.Range(-1, 3)
           from y in Enumerable.Range(-1, 3)
           from z in Enumerable.Range(-1, 3)
           where Math.Abs(x) + Math.Abs(y) + Math.Abs(z) > 1
           select Transformation.At(new Vector(x, y, z) / 3, scale: 1 / 3.0);
var caster = RayCaster.For(Fractal.Of(Shapes.Cube()).Repeat(maps, depth: 40));
var context = new QueryContext();
var towardsSun = new Vector(0.5, 0.8, -0.35);
for (var row = 0; row < 9; row++)
{
    // A ray as wide as a character takes what is smaller for one part.
    Console.WriteLine(string.Concat(Enumerable.Range(0, 36).Select(column =>
        !caster.TryFindNearest(
            new(new(0, 0, -2), new((column - 17.5) / 40, (4 - row) / 14.0, 1)), context, out var hit,
            footprint: new(Radius: 0, Spread: 0.01)) ? ' '
        : caster.HitsAny(
            new(hit.Point + (1e-9 * hit.Normal), towardsSun), context, footprint: new(Radius: 0.01, Spread: 0)) ? '.' : '#')).TrimEnd());
}

// Output:
//      #.#####.##.####.##.#####.#
//      #.#...#.##.#..#.##.#...#.#
//      #.##.##.##.####.##.##.##.#
//      #.##.##.#........#.##.##.#
//      #.#...#.#.      .#.#...#.#
//      #.##.##.#........#.##.##.#
//      #.##.##.##.####.##.##.##.#
//      #.#...#.##.#..#.##.#...#.#
//      #.##.##.##.####.##.##.##.#
