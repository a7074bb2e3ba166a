using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Repeating models of patches along one step: stairs, threads, wheels, columns, links and struts.</summary>
internal static class PatchModels
{
    /// <summary>Makes folded steps, straight ones or around the y axis.</summary>
    public static RepeatedPatches Stairs(SeededRandom random, int repeats, bool isSpiral)
    {
        var (rise, thickness, width) = (random.Written(0.12, 0.3), random.Written(0.1, 0.3), random.Written(0.8, 2));
        var going = isSpiral ? random.Pick(15, 18, 20, 22.5, random.Between(12, 30)) : random.Written(0.2, 0.5);
        var inner = isSpiral ? random.Written(0.1, 0.5) : 0;
        var builder = new ShapeBuilder();
        // From below the edge of the last step, around the step: one row on each side.
        (double Along, double Up)[] profile = [(0, -thickness), (0, 0), (0, rise), (1, rise), (1, rise - thickness)];
        var rows = new[] { inner, inner + width }
            .Select(across => builder.Vertices(profile.Select(point => Bend(point.Along * going, point.Up, across)))).ToArray();
        builder.Strip(rows[0][1..4], rows[1][1..4], isClosed: false);
        builder.Quad(rows[0][4], rows[0][0], rows[1][0], rows[1][4]);
        builder.Fan(rows[0][3], rows[0][2], rows[0][1], rows[0][0], rows[0][4]);
        builder.Fan(rows[1][3], rows[1][4], rows[1][0], rows[1][1], rows[1][2]);
        var step = isSpiral
            ? AffineMap.Translate(new(0, rise, 0)) * new AffineMap(Turn(going), Vector.Zero) : AffineMap.Translate(new(going, rise, 0));
        return RepeatedPatches.Along(builder.ToMesh(), step, repeats, "steps");

        Vector Bend(double along, double up, double across) =>
            isSpiral ? Turn(along) * new Vector(0, up, across) : new(along, up, across);
    }

    /// <summary>Makes the thread of a bolt; a sector of one pitch is a unit, which the next one follows along the screw.</summary>
    public static RepeatedPatches Bolt(SeededRandom random, int repeats)
    {
        var (sides, pitch, root, crest) =
            (random.Integer(8, 14), random.Written(0.1, 0.3), random.Written(0.4, 0.7), random.Written(0.8, 1));
        var step = AffineMap.Translate(new(0, pitch / sides, 0)) * new AffineMap(Turn(360.0 / sides), Vector.Zero);
        Vector[] profile =
        [
            new(root, 0, 0), new(root, 0.2 * pitch, 0), new(crest, 0.45 * pitch, 0), new(crest, 0.7 * pitch, 0), new(root, pitch, 0),
        ];
        var builder = new ShapeBuilder();
        builder.Strip(builder.Vertices(profile), builder.Vertices(profile.Select(point => step * point)), isClosed: false);
        return RepeatedPatches.Along(builder.ToMesh(), step, Math.Max(repeats, 3 * sides), "sectors of a thread");
    }

    /// <summary>Makes a wheel; the sector of a tooth is a unit.</summary>
    public static RepeatedPatches Gear(SeededRandom random, int repeats)
    {
        var (angle, thickness) = (360.0 / repeats, random.Written(0.1, 0.4));
        var (hole, root) = (random.Written(0.2, 0.5), random.Written(0.8, 0.9));
        (double Part, double Radius)[] outline = [(0, root), (0.25, root), (0.35, 1), (0.65, 1), (0.75, root), (1, root)];
        var builder = new ShapeBuilder();
        var (inner, outer) = (new int[2][], new int[2][]);
        for (var side = 0; side < 2; side++)
        {
            var height = side * thickness;
            inner[side] = builder.Vertices([Turn(0) * new Vector(hole, height, 0), Turn(angle) * new Vector(hole, height, 0)]);
            outer[side] = builder.Vertices(outline.Select(point => Turn(point.Part * angle) * new Vector(point.Radius, height, 0)));
        }

        int[] half1 = [inner[0][0], .. outer[0][..4]], half2 = [inner[0][1], inner[0][0], .. outer[0][3..]];
        builder.Fan(half1);
        builder.Fan(half2);
        builder.Fan([inner[1][0], .. outer[1][..4].Reverse()]);
        builder.Fan([inner[1][1], .. outer[1][3..].Reverse(), inner[1][0]]);
        builder.Strip(outer[1], outer[0], isClosed: false);
        builder.Strip(inner[0], inner[1], isClosed: false);
        return RepeatedPatches.Along(builder.ToMesh(), new(Turn(angle), Vector.Zero), repeats, "teeth around a wheel");
    }

    /// <summary>Makes columns on a square grid; a column with a tile of the floor and of the ceiling is a unit.</summary>
    public static RepeatedPatches Temple(SeededRandom random, int repeats)
    {
        const int Sides = 12;
        var (radius, height) = (random.Written(0.15, 0.25), random.Written(1.5, 3));
        (double Radius, double Height)[] profile =
        [
            (1.4, 0), (1.4, 0.08), (1, 0.12), (1.05, height / 3), (0.8, height - 0.2), (1.25, height - 0.1), (1.25, height),
        ];
        var builder = new ShapeBuilder();
        var row = builder.Vertices(TileBorder(0));
        foreach (var (size, y) in profile)
        {
            // Corners of a tile are at 45 degrees, and so are the first vertices of its column.
            var next = builder.Vertices(Enumerable.Range(0, Sides)
                .Select(i => Turn((360.0 * i / Sides) - 45) * new Vector(size * radius, y, 0)));
            builder.Strip(row, next, isClosed: true);
            row = next;
        }

        builder.Strip(row, builder.Vertices(TileBorder(height)), isClosed: true);
        var columns = Math.Max(2, (int)Math.Sqrt(repeats / random.Between(1, 4)));
        return RepeatedPatches.Grid(
            builder.ToMesh(), AffineMap.Translate(Vector.I), columns, AffineMap.Translate(Vector.K), (repeats + columns - 1) / columns,
            "columns");

        // From the corner (1/2, 1/2), the way that columns turn; three edges a side.
        IEnumerable<Vector> TileBorder(double y) => Enumerable.Range(0, Sides).Select(i =>
            Turn(90.0 * (i / 3)) * new Vector(0.5, y, TileBorderSign * (0.5 - (i % 3 / 3.0))));
    }

    /// <summary>Makes links of a chain, each a quarter turn on from the last one, straight or around a circle.</summary>
    public static RepeatedPatches Links(SeededRandom random, int repeats)
    {
        var (length, width, thickness) = (random.Written(0.6, 1), random.Written(0.28, 0.4), random.Written(0.06, 0.09));
        var (segments, sides) = (random.Pick(8, 12, 16), random.Integer(4, 6));
        var builder = new ShapeBuilder();
        var rings = new int[segments][];
        for (var i = 0; i < segments; i++)
        {
            // Around a stadium in the plane of x and y.
            var (sine, cosine) = SineCosine.FromDegrees(360.0 * (i + 0.5) / segments);
            var (centre, outwards) = (new Vector((cosine * width) + (cosine > 0 ? length / 2 : -length / 2), sine * width, 0),
                new Vector(cosine, sine, 0));
            rings[i] = builder.Vertices(ShapeBuilder.Around(sides, _ => thickness)
                .Select(point => centre + (point.X * outwards) + (point.Z * Vector.K)));
        }

        for (var i = 0; i < segments; i++)
        {
            builder.Strip(rings[i], rings[(i + 1) % segments], isClosed: true);
        }

        // Links touch where the inner sides of two ends would meet; a little slack keeps them apart.
        var pitch = length + (2 * (width - (1.2 * thickness)));
        var bend = random.Chance(0.5) ? Matrix.Identity : Turn(180.0 / repeats);
        var step = new AffineMap(bend * Matrix.Pitch(Math.PI / 2), pitch * Vector.I);
        return RepeatedPatches.Along(builder.ToSolid(), step, repeats, "links");
    }

    /// <summary>Makes a girder of square bays, whose struts are spindles from node to node.</summary>
    public static RepeatedPatches Truss(SeededRandom random, int repeats)
    {
        var (length, thickness) = (random.Written(0.7, 1.3), random.Written(0.03, 0.06));
        Vector[] corners = [new(0, 0, 0), new(0, 1, 0), new(0, 1, 1), new(0, 0, 1)];
        var bay = new ShapeBuilder();
        var near = bay.Vertices(corners);
        var far = bay.Vertices(corners.Select(corner => corner + (length * Vector.I)));
        var end = new ShapeBuilder();
        var last = end.Vertices(corners);
        for (var i = 0; i < 4; i++)
        {
            var next = (i + 1) % 4;
            AddStrut(bay, near[i], corners[i], far[i], corners[i] + (length * Vector.I), thickness);
            AddStrut(bay, near[i], corners[i], near[next], corners[next], thickness);
            AddStrut(bay, near[i], corners[i], far[next], corners[next] + (length * Vector.I), 0.7 * thickness);
            AddStrut(end, last[i], corners[i], last[next], corners[next], thickness);
        }

        return RepeatedPatches.Along(bay.ToMesh(), AffineMap.Translate(length * Vector.I), repeats, "bays of a girder")
            .With(end.ToMesh(), AffineMap.Translate(repeats * length * Vector.I));
    }

    // A rotation by -45 degrees has the corner with z = 1/2 or -1/2: the sign of a yaw.
    private static double TileBorderSign { get; } = Math.Sign((Turn(-45) * Vector.I).Z);

    private static Matrix Turn(double degrees) => new Vector(0, degrees, 0).LocalAxesFromDegrees();

    /// <summary>Adds a strut of three sides between two vertices, pointed at both ends.</summary>
    private static void AddStrut(ShapeBuilder builder, int start, Vector from, int end, Vector to, double thickness)
    {
        var along = to - from;
        var side = Vector.Cross(along, Math.Abs(along.X) > Math.Abs(along.Y) ? Vector.J : Vector.I).UnitVector();
        var (first, second) = (Ring(0.12), Ring(0.88));
        builder.Cone(start, first, reversed: true);
        builder.Strip(first, second, isClosed: true);
        builder.Cone(end, second);

        int[] Ring(double part) => builder.Vertices(Enumerable.Range(0, 3).Select(i =>
            from + (part * along) + (Matrix.Rotation(along.UnitVector(), 2 * Math.PI * i / 3) * (thickness * side))));
    }
}
