using System.Globalization;
using System.Text;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Images;
using FractalEngine.Tests.Support;
using static System.FormattableString;

namespace FractalEngine.Tests.Render;

/// <summary>
/// Writes the files of random scenes: up to four fractals and meshes, in all forms that files have for them, their lights and a camera.
/// The same seed gives the same files.
/// </summary>
/// <param name="random">The numbers of one scene.</param>
/// <param name="rig">
/// Numbers that several scenes share. They choose what shaders are compiled for: kinds of lights, fog, tone, sky.
/// </param>
internal sealed class RandomSceneTexts(Random random, Random rig)
{
    private const string PaintedCube = """
        v -0.5 -0.5 -0.5 1 0 0
        v 0.5 -0.5 -0.5 0 1 0
        v -0.5 0.5 -0.5 0 0 1
        v 0.5 0.5 -0.5 1 1 0
        v -0.5 -0.5 0.5 0 1 1
        v 0.5 -0.5 0.5 1 0 1
        v -0.5 0.5 0.5 1 1 1
        v 0.5 0.5 0.5 0.2 0.2 0.2
        f 1 3 4 2
        f 5 6 8 7
        f 1 5 7 3
        f 2 4 8 6
        f 1 2 6 5
        f 3 7 8 4

        """;

    // Two triangles that cross each other, and one without area: neither closed nor wound alike.
    private const string OpenMesh = """
        v -0.5 -0.5 0
        v 0.5 -0.5 0
        v 0 0.5 0
        v 0 -0.5 -0.5
        v 0 -0.5 0.5
        v 0.2 0.4 0.1
        f 1 2 3
        f 4 6 5
        f 1 1 2

        """;

    private const string Materials = """
        newmtl matt
        Kd 0.8 0.3 0.2
        newmtl glossy
        Kd 0.2 0.5 0.7
        Pr 0.3
        newmtl metal
        Kd 0.9 0.7 0.3
        Pm 1
        Pr 0.5
        newmtl bright
        Kd 0.3 0.3 0.3
        Ke 0.6 0.4 0.1
        newmtl texture
        Kd 1 1 1
        map_Kd tiles.png
        newmtl holes
        Kd 0.4 0.8 0.3
        map_d holes.png
        newmtl glass
        Kd 0.3 0.4 0.9
        d 0.5

        """;

    private static readonly string[] Shapes = ["box", "ball", "plate", "tetrahedron", "cylinder", "cone"];
    private static readonly string[] OpaqueMaterials = ["matt", "glossy", "metal", "bright", "texture", "holes"];
    private static readonly string[] Palettes = ["ember", "sea", "moss", "aurora"];
    private static readonly string[] Gradients = ["level", "path", "height", "distance", "trap"];

    /// <summary>Writes the files that all scenes name.</summary>
    public static void WriteSharedFiles(TemporaryFolder folder)
    {
        folder.Write("painted.obj", PaintedCube);
        folder.Write("open.obj", OpenMesh);
        folder.Write("m.mtl", Materials);
        byte[] tiles = [255, 64, 64, 255, 64, 255, 64, 255, 64, 64, 255, 255, 240, 240, 240, 255];
        ImageFile.SavePng(new(2, 2, tiles), folder["tiles.png"]);
        byte[] holes = [255, 255, 255, 255, 0, 0, 0, 255, 255, 255, 255, 255, 255, 255, 255, 255];
        ImageFile.SavePng(new(2, 2, holes), folder["holes.png"]);
    }

    /// <summary>Whether any object has a gradient.</summary>
    public bool HasGradient { get; private set; }

    /// <summary>Whether boxes of several colours touch, so that nothing decides which side is seen from within them.</summary>
    public bool HasTouchingColours { get; private set; }

    /// <summary>Writes the fractals of a scene, and returns the lines of its objects.</summary>
    public string WriteObjects(TemporaryFolder folder)
    {
        var lines = new StringBuilder();
        var count = random.Draw((50, 1), (25, 2), (15, 3), (10, 4));
        for (var i = 0; i < count; i++)
        {
            // A scene of many objects has smaller fractals.
            var budget = 3000 / count;
            var file = random.Draw((80, Invariant($"f{i}.fdo")), (12, "painted.obj"), (8, "open.obj"));
            var isGraded = file[0] == 'f' && random.Happens(25);
            if (file[0] == 'f')
            {
                folder.Write(file, random.Happens(30) ? BoxesSideBySide(budget, isGraded) : Fractal(budget));
            }

            lines.Append(Invariant($"o \"{file}\" {Placement(isFirst: i == 0)}"));
            lines.Append(random.Happens(50) ? Invariant($" colour {Colour()}") : "");
            lines.AppendLine(isGraded ? GradientOption() : "");
        }

        return lines.ToString();
    }

    /// <summary>Returns the lines of the camera, the lights and the air of a scene.</summary>
    /// <param name="bounds">Bounds of its objects, finite.</param>
    public string Stage(BoundingBox bounds)
    {
        var size = Math.Max(bounds.Diagonal, 1e-9);
        var centre = bounds.Centre;
        var lines = new StringBuilder();
        var closest = HasTouchingColours ? 0 : 20;
        var distance = size * random.Draw(
            (closest, 0), (closest, random.Between(0.3, 0.7)), (40, random.Between(0.7, 1.5)), (20, random.Between(2, 8)));
        var eye = distance == 0
            ? centre + (0.5 * bounds.Size.Stretch(random.Vector())) : centre + (distance * random.Direction());
        var target = centre + (0.3 * bounds.Size.Stretch(random.Vector()));
        var angle = distance > 1.6 * size && random.Happens(60) ? 60 * size / distance : random.Between(20, 100);
        lines.AppendLine(Invariant($"c {Text(eye)} look-at {Text(target)} up {Text(random.Direction())} {angle:R}"));
        lines.AppendLine(Invariant($"background {Colour()}"));
        if (random.Happens(35))
        {
            lines.AppendLine(Invariant($"projection orthographic {random.Between(0.3, 1.3) * size:R}"));
        }

        if (random.Happens(12) && !HasTouchingColours)
        {
            var near = Math.Max((eye - centre).Length() - (random.Between(0, 0.5) * size), 1e-3 * size);
            lines.AppendLine(Invariant($"clip {near:R} {near + (random.Between(0.2, 3) * size):R}"));
        }

        if (random.Happens(10))
        {
            lines.AppendLine("handed right");
        }

        AddLights(lines, centre, size);
        AddAir(lines, size);
        return lines.ToString();
    }

    private void AddLights(StringBuilder lines, Vector centre, double size)
    {
        var count = rig.Next(5);
        for (var i = 0; i < count; i++)
        {
            var range = random.Between(3, 20) * size;
            var place = Text(centre + (random.Between(0.2, 2) * size * random.Direction()));
            var direction = Text(random.Direction());
            var strength = Invariant($"{Colour()} {random.Between(0.2, 1.2):R}");
            lines.AppendLine(rig.Next(7) switch
            {
                0 => Invariant($"light ambient {Colour()} {random.Between(0.1, 0.6):R}"),
                1 => Invariant($"light directional {direction} {strength}"),
                2 => Invariant($"sun {direction} {strength} 1"),
                3 => Invariant($"light point {place} {strength} {range:R}"),
                4 => Invariant($"light spot {place} {direction} {random.Between(20, 120):R} {strength} {range:R}"),
                5 => Invariant($"light ball {place} {random.Between(0.01, 0.05) * range:R} {strength} {range:R}"),
                _ => Invariant($"light quad {place} {direction} {0.1 * range:R} {0.05 * range:R} {strength} {range:R}"),
            });
        }
    }

    private void AddAir(StringBuilder lines, double size)
    {
        if (rig.Happens(15))
        {
            lines.AppendLine(Invariant($"sky {Colour()} {Colour()}"));
        }

        switch (rig.Next(8))
        {
            case 0:
                lines.AppendLine(Invariant($"fog {random.Between(0.05, 1) / size:R} {Colour()}"));
                break;
            case 1:
                lines.AppendLine(Invariant($"fog {random.Between(0.05, 0.5) / size:R} {Colour()} scatter 0.7 forward 0.3"));
                break;
            case 2:
                lines.AppendLine("tone filmic");
                break;
        }
    }

    private string Placement(bool isFirst)
    {
        var position = isFirst ? Vector.Zero : random.Vector(random.Draw((3, 0.7), (1, 3.0)));
        var rotation = random.Draw((1, Vector.Zero), (1, random.Degrees()));
        var scale = random.Between(0.5, 2) * random.Draw<Vector>(
            (60, Vector.One), (12, new(-1, 1, 1)), (10, new(1, 0.02, 1)), (10, new(1, random.Between(0.3, 2), -0.7)), (8, -Vector.One));
        return isFirst && random.Happens(40) ? "#" : Invariant($"({Text(position)}, {Text(rotation)}, {Text(scale)})");
    }

    private string GradientOption()
    {
        HasGradient = true;
        var colours = random.Next(4) switch
        {
            0 => Colour(),
            1 => Invariant($"{Colour()} {Colour()} {Colour()}"),
            2 => Invariant($"0 {Colour()} 0.4 {Colour()} 0.4 {Colour()} 1 {Colour()}"),
            _ => Invariant($"\"{Pick(Palettes)}\""),
        };
        var surface = random.Next(6) switch { 0 => " roughness 0.3 0.9", 1 => " glow 0 0.8", _ => "" };
        return Invariant($" gradient {Pick(Gradients)} {colours}{surface}");
    }

    /// <summary>Creates a fractal of every form that the grammar has.</summary>
    private string Fractal(int budget)
    {
        var text = new StringBuilder();
        text.AppendLine(Invariant($"seed {random.Next(100)}{(random.Happens(25) ? " by level" : "")}"));
        text.AppendLine("v 0.5 0.3 -0.2\nv 0.6 0.6 0.6\nt.a. (a, #, 2)");
        text.AppendLine(Invariant($"turn. (#, {Text(random.Degrees())}, #)\nstep. ({Text(random.Vector())}, #, (0.8))"));
        text.AppendLine("lean.matrix (1, 0, 0) (0.4, 1, 0) (0, 0.2, 1) (0, 0.3, 0)");
        // Nothing decides which of two shapes at one place is seen: the second is moved, and turned.
        text.AppendLine(Invariant($"x. {Base()}\ny. [((0.13, 0.07, -0.05), (7, 11, 13), (0.9))] {Base()}"));
        switch (random.Next(10))
        {
            case 0:
            case 1:
                // One wide set, or a deep one.
                var width = random.Draw((70, random.Next(1, 9)), (20, random.Next(9, 30)), (10, random.Next(30, 141)));
                text.AppendLine(Invariant($"z<x>. [{Maps(width)}] x\n<$>. z {Depth(width, budget)}"));
                break;
            case 2:
                var (first, second) = (random.Next(1, 4), random.Next(1, 3));
                text.AppendLine(Invariant($"z<x>. [{Maps(first)}] x + [{Maps(second)}] x + y"));
                text.AppendLine(Invariant($"<$>. z {Depth(first + second + 0.5, budget)}"));
                break;
            case 3:
                text.AppendLine(Invariant($"z<x>. 3: [{Maps(3)}] x | {random.Next(3)}: [{Maps(2)}] x + y | 1: x"));
                text.AppendLine(Invariant($"<$>. z {Depth(3.5, budget)}"));
                break;
            case 4:
                text.AppendLine(Invariant($"z<x>, w<y>. [{Maps(2)}] x + [{Maps(1)}] y, [{Maps(2)}] x + y + [{Map()}] y"));
                text.AppendLine(Invariant($"<$>. {Pick(["z", "w"])} {Depth(4, budget)}"));
                break;
            case 5:
                text.AppendLine(Invariant($"z<x>. [{Maps(random.Next(2, 4), 0.3, 0.6)}] x{(random.Happens(50) ? " + y" : "")}"));
                text.AppendLine(Invariant($"<$>. z until {random.Between(0.05, 0.3):R}"));
                break;
            case 6:
                var (row, column) = (random.Next(2, 30), random.Next(2, 30));
                text.AppendLine(Invariant($"<$>. [turn.^0..{row}] [step.^0..{column}] {Pick(["x", "(x + y)", "(2: x | 1: y)"])}"));
                break;
            case 7:
                text.AppendLine(Invariant($"z<x>. [{Maps(2)}] x + y\nq. z 2\ns<q>. [{Maps(3)}] q\n<$>. s {Depth(3, budget / 10.0)}"));
                break;
            case 8:
                text.AppendLine(Invariant($"z<x>. [{Maps(3)}] x + (level 0..1: y | 2..: [step.] y)\n<$>. z {Depth(3.5, budget)}"));
                break;
            default:
                text.AppendLine(Invariant($"z<x>. [#, turn. * step.^1..2, lean.] (1: x | 1: [{Map()}] x)"));
                text.AppendLine(Invariant($"<$>. [{Maps(2)}] z {Depth(4, budget / 2.0)}"));
                break;
        }

        return text.ToString();
    }

    /// <summary>
    /// Creates boxes of a grid, of which neighbours cover sides: some are missing, doubled, turned, moved, or of another size.
    /// </summary>
    private string BoxesSideBySide(int budget, bool isGraded)
    {
        var count = random.Draw((1, 2), (2, 3), (1, 4));
        var size = Math.Pow(10, random.Draw((6, 0), (1, -4), (1, 4)));
        var share = random.Next(30, 101);
        HasTouchingColours |= isGraded;
        // Sides in one plane have one colour: nothing decides which of two is seen.
        var oddShare = isGraded || random.Happens(60) ? 0 : random.Next(1, 30);
        List<string> maps = [];
        for (var i = 0; i < count * count * count; i++)
        {
            var place = (new Vector(i % count, i / count % count, i / count / count) - (0.5 * (count - 1) * Vector.One)) / count;
            var rotation = Vector.Zero;
            var scale = Vector.One / count;
            if (!random.Happens(share) && maps.Count > 0)
            {
                continue;
            }

            if (random.Happens(oddShare))
            {
                switch (random.Next(5))
                {
                    case 0:
                        rotation = 90 * new Vector(random.Next(4), random.Next(4), random.Next(4));
                        break;
                    case 1:
                        scale = scale.Stretch(new(-1, 1, 1));
                        break;
                    case 2:
                        place += Math.Pow(10, -random.Next(1, 13)) / count * random.Direction();
                        break;
                    case 3:
                        scale *= random.Between(0.5, 1);
                        break;
                    default:
                        maps.Add(Invariant($"({Text(size * place)}, #, {Text(scale)})"));
                        break;
                }
            }

            var colour = oddShare == 0 && random.Happens(10) ? Invariant($" colour {Colour()} 0.5") : "";
            HasTouchingColours |= colour.Length > 0;
            maps.Add(Invariant($"({Text(size * place)}, {Text(rotation)}, {Text(scale)}){colour}"));
        }

        var set = string.Join(", ", maps);
        var depth = Depth(maps.Count, budget);
        var box = oddShare == 0 && random.Happens(30) ? "\"painted.obj\"" : Pick(["box", "box material \"m.mtl\" \"matt\""]);
        HasTouchingColours |= box[0] == '"';
        var start = Invariant($"x. [(#, #, ({size:R}))] {box}\n");
        return start + (random.Next(5) switch
        {
            0 => Invariant($"z<x>. 3: [{set}] x | 1: x\n<$>. z {depth}\n"),
            1 => Invariant($"z<x>. [{set}] x + [({Text(random.Vector(0.5 * size))}, (9, 8, 7), (0.2))] x\n<$>. z {depth}\n"),
            2 => Invariant($"z<x>. [{set}] x\n<$>. z until {size * random.Between(0.1, 0.6):R}\n"),
            _ => Invariant($"z<x>. [{set}] x\n<$>. z {depth}\n"),
        });
    }

    private string Base() => random.Next(8) switch
    {
        0 => "\"painted.obj\"",
        1 => "\"open.obj\"",
        2 or 3 => Invariant($"{Pick(Shapes)} material \"m.mtl\" \"{Pick(OpaqueMaterials)}\""),
        _ => Pick(Shapes),
    };

    private string Maps(int count, double minScale = 0.25, double maxScale = 0.8) => string.Join(
        ", ",
        Enumerable.Range(0, count).Select(i =>
            i == 0 && count > 1 && maxScale > 0.6 && random.Happens(8) ? "#" : Map(minScale, maxScale)));

    private string Map(double minScale = 0.25, double maxScale = 0.8)
    {
        if (minScale < 0.3 && random.Happens(10))
        {
            return Pick(["t.1", "step.^2", "turn. * step.", "(lean. * step.)^2"]) + Invariant($" * ({Text(random.Vector(0.3))}, #, #)");
        }

        var factor = random.Between(minScale, maxScale);
        var scale = random.Draw<Vector>(
            (70, factor * Vector.One), (10, factor * new Vector(1, -1, 1)), (10, new(factor, 0.5 * factor, factor)),
            (5, 0.1 * factor * Vector.One), (5, new(factor, factor, 1e-3)));
        var rotation = random.Draw((3, Vector.Zero), (3, random.Degrees()), (1, 90 * new Vector(random.Next(4), random.Next(4), 0)));
        var colour = random.Happens(10) ? Invariant($" colour {Colour()} 0.3") : "";
        return Invariant($"({Text(random.Vector())}, {Text(rotation)}, {Text(scale)}){colour}");
    }

    private int Depth(double factor, double budget) =>
        random.Next(1, 1 + Math.Clamp((int)(Math.Log(Math.Max(budget, 2)) / Math.Log(Math.Max(factor, 1.2))), 1, 12));

    private string Colour() => Text(new Vector(random.NextDouble(), random.NextDouble(), random.NextDouble()));

    private string Pick(string[] items) => items[random.Next(items.Length)];

    private static string Text(Vector v) => string.Create(CultureInfo.InvariantCulture, $"({v.X:R}, {v.Y:R}, {v.Z:R})");
}
