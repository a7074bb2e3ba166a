#:project ../FractalEngine.Core/FractalEngine.Core.csproj
#:property PublishAot=false
// Looks at a Menger sponge of 10^53 faces with exact rays, and at its shadows.
using FractalEngine.Core.Collision;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Rays;

var maps = from x in Enumerable.Range(-1, 3)
           from y in Enumerable.Range(-1, 3)
           from z in Enumerable.Range(-1, 3)
           where Math.Abs(x) + Math.Abs(y) + Math.Abs(z) > 1
           select Transformation.At(new Vector(x, y, z) / 3, scale: 1 / 3.0);
var sponge = Fractal.Of(Shapes.Cube()).Repeat(maps, depth: 40);

// Kilobytes, whatever the depth. Each thread has a context of its own; rays with one allocate nothing.
var caster = RayCaster.For(sponge);
var context = new QueryContext();
var eye = new Vector(1.1, 0.9, -2.2);
var sun = new Vector(0.5, 0.8, -0.35).UnitVector();
var forward = (-eye).UnitVector();
var right = Vector.Cross(Vector.J, forward).UnitVector();
var up = Vector.Cross(forward, right);
const string shades = " .:-=+*#%@";
for (var row = 2; row < 23; row++)
{
    var line = "";
    for (var column = 0; column < 64; column++)
    {
        var direction = forward + ((column - 31.5) / 96 * right) - ((row - 11.5) / 44 * up);
        // A ray as wide as a character takes what is smaller for one part.
        if (!caster.TryFindNearest(new(eye, direction), context, out var hit, footprint: new(0, 0.01)))
        {
            line += ' ';
            continue;
        }

        // The sun reaches what nothing hides; a ray that leaves a surface starts a little beside it.
        var normal = hit.IsFrontFace ? hit.Normal : -hit.Normal;
        var isLit = !caster.HitsAny(new(hit.Point + (1e-9 * normal), sun), context, footprint: new(0.01, 0));
        var brightness = 0.25 + (isLit ? 0.75 * Math.Max(0, Vector.Dot(normal, sun)) : 0);
        line += shades[(int)(brightness * (shades.Length - 1))];
    }

    Console.WriteLine(line.TrimEnd());
}

// Output:
//                     ###+#+===########==#=#
//            ==#+#########=++++====:====:===#=#########=++
//    =====#=####=#+###=##++===########=#=########=#=+++==+
//    ==::=+:==:=====#==:=======##=###==##=###=###++:++++=+
//     ======:==========:==::====:========:====++=#+=+++==+
//     ::==:::===+==:=+::=====:========:===::+==+++=+=++++
//     ====+:::=====:==::::========::::=:======+:=+++#++++
//     ==:=====::======##:::=====#:=+::::==:======+++=+++=
//      ==#=====#==::===:=====+=====#=#::=====+++#=++:==#+
//      ::====#+===:===:=====#==:::========:==++++#:===+=#
//      ========+::+:::::::===#:===:=======:=:#+++==+===+
//      =+:=:::====+::::::::::::=::===:=======++=++=:=++#
//       ===+#:==##++:::::::::::======#====:==+++++===+=+
//       =::=:===:=+++::::::::::====:::::==#==++=++###=++
//       :=======#==++###::::::::===+::::=+====+#+##+#+=+
//       =#===:======####===#:::===:===#:#=:==+++++++++++
//       ====:=#====#:=======##::=====:========++=+==+=
//        ===+::========:====:=====:=====:====+##++#++
//        ::=+=======+:=::::====:=====:=====:+=+==++#
//         ====:==:=====###:=#=====:::===:===++=++=
//                ====#=::==#=======+::::===:=+#++
