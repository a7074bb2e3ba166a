using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Physics;

/// <summary>Distances from the infinite Menger sponge of side 1 about the origin, by its definition: 20 of 27 cubes, and so on.</summary>
internal static class MengerDistanceOracle
{
    private static readonly Vector[] ChildOffsets =
    [
        .. from x in new[] { -1, 0, 1 }
           from y in new[] { -1, 0, 1 }
           from z in new[] { -1, 0, 1 }
           where (x * x) + (y * y) + (z * z) > 1
           select new Vector(x, y, z) / 3,
    ];

    /// <summary>
    /// Lower bound on the distance, exact to 1e-9: that of the closest cube which is too small to matter where the sponge is in it.
    /// </summary>
    public static double Distance(Vector position)
    {
        var queue = new PriorityQueue<(Vector Centre, double Size), double>();
        var centre = Vector.Zero;
        var size = 1.0;
        var bound = 0.0;
        while (size >= 1e-9 && bound <= 1e9 * size)
        {
            foreach (var offset in ChildOffsets)
            {
                var child = centre + (size * offset);
                var outside = Vector.Max((position - child).Absolute() - (size / 6 * Vector.One), Vector.Zero);
                queue.Enqueue((child, size / 3), outside.Length());
            }

            _ = queue.TryDequeue(out var next, out bound);
            (centre, size) = next;
        }

        return bound;
    }
}
