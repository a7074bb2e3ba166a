using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Fractals.Levels.Building;

/// <summary>Repetitions whose levels double: all their steps are there, at depths about every power of two.</summary>
public class MapPowersTests
{
    /// <summary>A winding staircase of n steps above the first: a query in the middle of each finds just that step.</summary>
    [Fact]
    public void Staircase_OfAnyDepth_HasEachStep()
    {
        var turn = new Transformation(new(0.1, 0, 0.7), new(0, 0, 25), Vector.One);
        var middle = (1 / 3.0) * new Vector(1, 1, 0);
        var context = new QueryContext();
        for (var depth = 1; depth <= 70; depth++)
        {
            var collider = new ExactFractalCollider(new Fractal(
                new([new Repetition([TransformationSet.Of([turn, Transformation.Identity])], depth)]), Samples.Triangle));
            var map = AffineMap.Identity;
            for (var step = 0; step <= depth; step++)
            {
                Assert.True(collider.TryFindClosest(map * middle, 10, context, out var closest), $"{depth}");
                Assert.True(closest.Distance < 1e-12 * (1 + step), $"step {step} of {depth} is {closest.Distance} away");
                map *= turn.ToAffineMap();
            }

            Assert.True(collider.TryFindClosest(map * middle, 10, context, out var beyond));
            Assert.True(beyond.Distance > 0.6, $"a staircase of {depth} steps has one more");
        }
    }
}
