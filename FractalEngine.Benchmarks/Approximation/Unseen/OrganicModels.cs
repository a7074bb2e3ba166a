using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Makes irregular shapes by a kind, a seed and a number of faces: what no fractal is likely to fit exactly.</summary>
/// <remarks>
/// The whole shape is its one element, and there are no generators. No file of a few maps can grade as found; what counts is how small the
/// distances get for how large a file, and that the search ends.
/// </remarks>
internal static class OrganicModels
{
    /// <summary>Makes the shape of a kind and a seed, shuffled but without other damage.</summary>
    /// <param name="kind">What shape it is.</param>
    /// <param name="seed">Chooses all proportions and noise; any integer.</param>
    /// <param name="faces">About how many faces it has; at least 100.</param>
    public static UnseenInput Create(OrganicKind kind, int seed, int faces)
    {
        ArgumentOutOfRangeException.ThrowIfLessThan(faces, 100);
        var random = new SeededRandom(kind.ToString(), seed);
        var frame = ModelFrame.Draw(random);
        var noise = new ValueNoise(random);
        var offset = 16 * random.InBox(1);
        var shape = kind switch
        {
            OrganicKind.NoisySphere => Sphere(faces, direction =>
                (1 + (0.25 * noise.Sum((2.5 * direction) + offset, 4))) * direction),
            OrganicKind.Creature => Creature(faces, random, noise),
            OrganicKind.Terrain => Terrain(faces, (x, z) => 0.12 * noise.Sum((6 * new Vector(x, 0, z)) + offset, 5)),
            OrganicKind.Rock => Rock(faces, random, noise),
            OrganicKind.Bust => Bust(faces, random, noise),
            _ => throw new ArgumentOutOfRangeException(nameof(kind), kind, "no kind of shape"),
        };
        var clean = MeshTools.Move(shape, frame);
        var description = FormattableString.Invariant($"{kind} {seed}: irregular, {clean.FaceCount} faces");
        return Damage.None.Apply(
            new(kind.ToString(), seed, description, clean, clean, [new(0, clean.FaceCount, 0)], [clean], [0], [], 0, 0), seed);
    }

    /// <summary>Makes the image of a sphere of meridians and parallels.</summary>
    private static Mesh Sphere(int faces, Func<Vector, Vector> place)
    {
        // Even, so that a mirror across x = 0 maps vertices to vertices.
        var segments = 2 * Math.Max(3, (int)Math.Round(Math.Sqrt(faces) / 2));
        var rows = Math.Max(3, (int)Math.Round((double)faces / (2 * segments)) + 1);
        var builder = new ShapeBuilder();
        var above = builder.Vertex(place(Vector.J));
        int[]? last = null;
        for (var row = 1; row < rows; row++)
        {
            var (sine, cosine) = SineCosine.FromDegrees(180.0 * row / rows);
            var ring = builder.Vertices(
                ShapeBuilder.Around(segments, _ => sine).Select(point => place(new(point.X, cosine, point.Z))));
            if (last is null)
            {
                builder.Cone(above, ring);
            }
            else
            {
                builder.Strip(ring, last, isClosed: true);
            }

            last = ring;
        }

        builder.Cone(builder.Vertex(place(-Vector.J)), last!, reversed: true);
        return builder.ToSolid();
    }

    private static Mesh Creature(int faces, SeededRandom random, ValueNoise noise)
    {
        // Limbs and head: lobes to the right, each with its mirror image.
        var lobes = Enumerable.Range(0, random.Integer(4, 7))
            .Select(_ => (Direction: random.Direction(), Height: random.Between(0.4, 1.4), Sharpness: random.Between(8, 40))).ToArray();
        return Sphere(faces, direction =>
        {
            var right = new Vector(Math.Abs(direction.X), direction.Y, direction.Z);
            var radius = 0.6 + (0.06 * noise.Sum(3 * right, 3));
            foreach (var (lobe, height, sharpness) in lobes)
            {
                var towards = new Vector(Math.Abs(lobe.X), lobe.Y, lobe.Z);
                radius += height * Math.Exp(sharpness * (Vector.Dot(right, towards) - 1));
            }

            return radius * direction.Stretch(new(0.8, 1, 1.3));
        });
    }

    private static Mesh Terrain(int faces, Func<double, double, double> height)
    {
        var cells = (int)Math.Round(Math.Sqrt(faces / 2.0));
        var builder = new ShapeBuilder();
        int[]? last = null;
        for (var row = 0; row <= cells; row++)
        {
            var z = (double)row / cells;
            var vertices = builder.Vertices(
                Enumerable.Range(0, cells + 1).Select(column => (double)column / cells).Select(x => new Vector(x, height(x, z), z)));
            if (last is not null)
            {
                builder.Strip(last, vertices, isClosed: false);
            }

            last = vertices;
        }

        return builder.ToMesh();
    }

    private static Mesh Rock(int faces, SeededRandom random, ValueNoise noise)
    {
        var planes = Enumerable.Range(0, 14).Select(_ => (Normal: random.Direction(), Distance: random.Between(0.6, 0.9))).ToArray();
        return Sphere(faces, direction =>
        {
            var radius = 1.1;
            foreach (var (normal, distance) in planes)
            {
                var cosine = Vector.Dot(direction, normal);
                radius = cosine * radius > distance ? distance / cosine : radius;
            }

            return (radius + (0.02 * noise.Sum(8 * direction, 3))) * direction;
        });
    }

    private static Mesh Bust(int faces, SeededRandom random, ValueNoise noise)
    {
        var (shoulder, neck, head) = (random.Between(0.7, 1), random.Between(0.2, 0.3), random.Between(0.35, 0.5));
        return Sphere(faces, direction =>
        {
            // From the top of the head downwards.
            var down = Math.Acos(Math.Clamp(direction.Y, -1, 1)) / Math.PI;
            var around = direction with { Y = 0 };
            var unit = around.Length() > 1e-9 ? around / around.Length() : Vector.Zero;
            var profile = (head * Bump(down, 0.25, 0.2)) + (neck * Bump(down, 0.5, 0.3)) + (shoulder * Bump(down, 0.8, 0.22));
            var radius = profile * (1 + (0.15 * noise.Sum((2 * unit) + new Vector(0, 8 * down, 0), 4)));
            return (radius * unit) + new Vector(0, 2.4 * (1 - down), 0);
        });
    }

    private static double Bump(double position, double centre, double width) => Math.Sqrt(Math.Max(
        0, 1 - Math.Pow((position - centre) / (1.25 * width), 2)));
}
