using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Queries.Closest;

/// <summary>
/// Creates random fractals of few instances with all that breaks bounds: skew, mirrors, maps close to singular, overlaps, identities,
/// several sets a level, huge and tiny scales and translations, faces without area, wide sets. Half of them are <see cref="RandomShapes"/>.
/// </summary>
internal static class RandomAdversarialFractals
{
    private const int MaxChains = 400;

    public static Fractal Create(Random random)
    {
        if (random.Next(2) == 0)
        {
            return RandomShapes.Create(random, MaxChains);
        }

        var steps = new List<FractalStep>();
        var chains = 1L;
        var spread = Spread(random);
        do
        {
            var width = random.Next(10) == 0 ? random.Next(65, 100) : random.Next(1, 6);
            var step = CreateSet(random, width, spread);
            var count = 1;
            while (chains * (long)Math.Pow(width, count + 1) <= MaxChains && count < 12 && random.Next(4) != 0)
            {
                count++;
            }

            if (chains * (long)Math.Pow(width, count) > MaxChains)
            {
                break;
            }

            chains *= (long)Math.Pow(width, count);
            steps.Add(count == 1 ? step : new Repetition([step], count));
        }
        while (random.Next(3) != 0);
        return new(new([.. steps]), CreateBase(random));
    }

    private static double Spread(Random random) => random.Next(3) switch
    {
        0 => 0,
        1 => 2,
        _ => 8,
    };

    private static TransformationSet CreateSet(Random random, int width, double spread)
    {
        var transformations = Enumerable.Range(0, width).Select(_ => CreateMap(random, spread)).ToList();
        if (width > 1 && random.Next(4) == 0)
        {
            transformations[random.Next(width)] = Transformation.Identity;
        }

        if (width > 2 && random.Next(6) == 0)
        {
            transformations[0] = transformations[1];
        }

        return TransformationSet.Of(transformations);
    }

    private static Transformation CreateMap(Random random, double spread)
    {
        var scale = random.Next(6) switch
        {
            0 => random.Vector(0.8),
            1 => random.NextDouble() * Vector.One,
            2 => new(0.6, 0.6, Math.Pow(10, -random.Next(6, 12))),
            3 => -0.5 * Vector.One,
            4 => new(0.5, -0.5, 0.5),
            _ => 0.5 * Vector.One,
        };
        var exponent = random.Next(4) == 0 ? spread * ((2 * random.NextDouble()) - 1) : 0;
        scale = scale.Absolute().MaxAbsComponent() > 1e-13 ? scale : Vector.One;
        scale = new(NonZero(scale.X), NonZero(scale.Y), NonZero(scale.Z));
        var rotation = random.Next(2) == 0 ? Vector.Zero : 180 * random.Vector(1);
        return new(Math.Pow(10, exponent) * random.Vector(1.5), rotation, Math.Pow(10, random.Next(6) == 0 ? exponent / 2 : 0) * scale);
    }

    private static double NonZero(double scale) => Math.Abs(scale) < 1e-13 ? 0.3 : scale;

    private static Mesh CreateBase(Random random) => random.Next(5) switch
    {
        0 => Samples.Tetrahedron.Transform(v => v + (1000 * Vector.One)),
        1 => new([0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1e-9], [0, 1, 2, 1, 3, 2]),
        2 => new([0, 0, 0, 1, 1, 1, 0.5, 0.5, 0.5, 0, 1, 0], [0, 1, 2, 0, 1, 3]),
        _ => Samples.Tetrahedron,
    };
}
