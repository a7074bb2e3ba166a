#:project ../FractalEngine.Parsing/FractalEngine.Parsing.csproj
#:property PublishAot=false
// Makes a tree in code: one set of maps for its twigs, another for its leaves; counts it at any depth, and writes it as a file.
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing;

var branch = Shapes.Box(new(new(-0.05, 0, -0.05), new(0.05, 1, 0.05)));
Transformation[] twigs =
[
    Transformation.Identity,
    new(new(0, 1, 0), new(0, 0, 30), 0.7 * Vector.One),
    new(new(0, 1, 0), new(0, 120, -25), 0.7 * Vector.One),
];
var tree = Fractal.Of(branch).Repeat(twigs, depth: 8);
foreach (var depth in (int[])[1, 8, 1000])
{
    var digits = tree.WithDepth(depth).FaceCount!.Value.ToString("E3", System.Globalization.CultureInfo.InvariantCulture);
    Console.WriteLine($"depth {depth}: {digits} faces");
}

// The identity in a set makes the same instance many times; each is drawn and tested only once.
Console.WriteLine($"{tree.InstanceCount} instances, {DistinctInstances.Count(tree)} distinct");
Console.WriteLine($"bounds {tree.Bounds.Size}");

FractalFile.Write("out/tree.fdo", tree);
Console.WriteLine($"read back: {FractalFile.Read("out/tree.fdo").Equals(tree)}");

// Output:
// depth 1: 3.600E+001 faces
// depth 8: 7.873E+004 faces
// depth 1000: 1.586E+478 faces
// 6561 instances, 511 distinct
// bounds (2.0204651977727015, 3.0606328139240744, 1.481105153930851)
// read back: True
