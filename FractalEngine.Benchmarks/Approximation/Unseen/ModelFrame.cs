using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Draws where a whole model stands: as it was made, turned as people turn things, or anywhere in any size.</summary>
internal static class ModelFrame
{
    /// <summary>Draws the similarity that is applied to a whole model; the identity in one of three cases.</summary>
    public static AffineMap Draw(SeededRandom random) => random.Index(3) switch
    {
        0 => AffineMap.Identity,
        1 => new(random.NiceRotation(), new(random.Integer(-3, 3), random.Integer(-3, 3), random.Integer(-3, 3))),
        _ => DrawGeneric(random),
    };

    private static AffineMap DrawGeneric(SeededRandom random)
    {
        var size = Math.Pow(10, random.Between(-2, 3));
        return new(size * random.GenericRotation(), 3 * size * random.InBox(1));
    }
}
