#:project ../FractalEngine.Core/FractalEngine.Core.csproj
#:property PublishAot=false
// Finds the point of a Menger sponge of 10^53 faces that is closest to a position, exactly.
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;

// The 20 of 27 small cubes that are not in the middle of a side or of the whole.
var maps = from x in Enumerable.Range(-1, 3)
           from y in Enumerable.Range(-1, 3)
           from z in Enumerable.Range(-1, 3)
           where Math.Abs(x) + Math.Abs(y) + Math.Abs(z) > 1
           select Transformation.At(new Vector(x, y, z) / 3, scale: 1 / 3.0);
var sponge = Fractal.Of(Shapes.Cube()).Repeat(maps, depth: 40);

var collider = Collider.For(sponge);
var nearest = collider.FindClosest(new(1, 2, 3));
Console.WriteLine($"{sponge.FaceCount} faces within {sponge.Bounds}");
Console.WriteLine(FormattableString.Invariant($"distance {nearest.Distance:F12} to {nearest.Point}, normal {nearest.Normal}"));
Console.WriteLine($"instance {string.Join(' ', nearest.InstancePath.Take(10))} ... {nearest.InstancePath.Length} levels");

// A second query with a context says what it cost: the paper's collision cost is the number of faces tested.
var context = new QueryContext();
if (collider.TryFindClosest(new(0.1, 0.1, 0.1), maxDistance: 0.5, context, out var closest))
{
    Console.WriteLine(
        FormattableString.Invariant($"distance {closest.Distance:F12} after {context.Statistics.FaceTests} of {sponge.FaceCount} faces"));
}

// Right to about 1e-15: parts below the last digit of the coordinates count as their base mesh, hence 32 of 40 levels. Several faces
// meet at the corner, and the normal is that of one of them.
//
// Output:
// 131941395333120000000000000000000000000000000000000000 faces within (-0.5, -0.5, -0.5)..(0.5, 0.5, 0.5)
// distance 2.958039891550 to (0.4999999999999982, 0.4999999999999999, 0.4999999999999999), normal (-1, 0, 0)
// instance 19 19 19 19 19 19 19 19 19 19 ... 32 levels
// distance 0.094280904158 after 12 of 131941395333120000000000000000000000000000000000000000 faces
