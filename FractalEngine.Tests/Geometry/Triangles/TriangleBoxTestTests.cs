using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Geometry.Triangles;

/// <summary>The test of a triangle and a box against the triangle that is cut off at the sides of the box.</summary>
public sealed class TriangleBoxTestTests
{
    private const double Slack = 1e-9;

    private static readonly BoundingBox Unit = new(Vector.Zero, Vector.One);

    [Fact]
    public void Meets_OfRandomTriangles_AgreesWithTheTriangleCutAtTheSides()
    {
        var (meetings, misses) = (0, 0);
        Seeded.Run(60, random =>
        {
            for (var i = 0; i < 100; i++)
            {
                // On a grid, edges are often parallel to sides, and in planes with them.
                var isGrid = random.Next(2) == 0;
                var box = BoxOf(Draw(random, isGrid), Draw(random, isGrid));
                var (a, b, c) = (Draw(random, isGrid), Draw(random, isGrid), Draw(random, isGrid));
                var isMeeting = TriangleBoxTest.Meets(a, b, c, box, 0);
                if (IsAnythingLeft([a, b, c], Grown(box, -Slack)))
                {
                    meetings++;
                    Ensure.That(isMeeting, $"{a} {b} {c} meets {box}");
                }
                else if (!IsAnythingLeft([a, b, c], Grown(box, Slack)))
                {
                    misses++;
                    Ensure.That(!isMeeting, $"{a} {b} {c} is apart from {box}");
                }

                Assert.Equal(isMeeting, TriangleBoxTest.Meets(b, c, a, box, 0));
                Assert.Equal(isMeeting, TriangleBoxTest.Meets(a, c, b, box, 0));
            }
        });
        Assert.InRange(meetings, 500, 5500);
        Assert.InRange(misses, 500, 5500);
    }

    [Fact]
    public void Meets_OfABoxAndATolerance_AgreesWithTheGrownBox() => Seeded.Run(60, random =>
    {
        for (var i = 0; i < 50; i++)
        {
            var tolerance = random.Between(0.1, 1);
            var box = BoxOf(Draw(random, false), Draw(random, false));
            var (a, b, c) = (Draw(random, false), Draw(random, false), Draw(random, false));
            // The tolerance reaches from the sides, and past edges and corners no farther than a grown box does.
            if (!IsAnythingLeft([a, b, c], Grown(box, tolerance + Slack)))
            {
                Assert.False(TriangleBoxTest.Meets(a, b, c, box, tolerance));
            }
            else if (IsAnythingLeft([a, b, c], box))
            {
                Assert.True(TriangleBoxTest.Meets(a, b, c, box, tolerance));
            }
        }
    });

    /// <summary>A plane, an edge and a corner that touch the box, and the same a little farther.</summary>
    [Fact]
    public void Meets_OfATriangleThatTouches_IsTrueAndAllowsTheTolerance()
    {
        (Vector A, Vector B, Vector C, Vector Away)[] touching =
        [
            (new(3, 0, 0), new(0, 3, 0), new(0, 0, 3), Vector.One),
            (new(1, 1, 1), new(2, 2, 3), new(3, 2, 2), Vector.One),
            (new(0.5, 2, 0), new(0.5, 0, 2), new(0.5, 4, 4), new(0, 1, 1)),
            (new(2, 0.5, 0), new(0, 0.5, 2), new(4, 0.5, 4), new(1, 0, 1)),
            (new(2, 0, 0.5), new(0, 2, 0.5), new(4, 4, 0.5), new(1, 1, 0)),
            (new(1, 0.2, 0.2), new(1, 0.8, 0.2), new(1, 0.5, 0.9), Vector.I),
            (new(0, 0.2, 0.2), new(0, 0.8, 0.2), new(0, 0.5, 0.9), -Vector.I),
            (new(0.2, 1, 0.2), new(0.8, 1, 0.2), new(0.5, 1, 0.9), Vector.J),
            (new(0.2, 0.2, 0), new(0.8, 0.2, 0), new(0.5, 0.9, 0), -Vector.K),
        ];
        foreach (var (a, b, c, away) in touching)
        {
            Assert.True(TriangleBoxTest.Meets(a, b, c, Unit, 0));
            var shift = 1e-6 * away;
            Assert.False(TriangleBoxTest.Meets(a + shift, b + shift, c + shift, Unit, 0));
            Assert.False(TriangleBoxTest.Meets(a + shift, b + shift, c + shift, Unit, 0.9e-6));
            Assert.True(TriangleBoxTest.Meets(a + shift, b + shift, c + shift, Unit, 1.1e-6));
        }
    }

    [Fact]
    public void Meets_OfTwoBoxes_IsTrueUpToTheToleranceAlongEachAxis()
    {
        foreach (var axis in new[] { Vector.I, Vector.J, Vector.K, -Vector.I, -Vector.J, -Vector.K })
        {
            var other = new BoundingBox(Unit.Minimum + (1.5 * axis), Unit.Maximum + (1.5 * axis));
            Assert.True(TriangleBoxTest.Meets(Unit, other, 0.5));
            Assert.True(TriangleBoxTest.Meets(other, Unit, 0.5));
            Assert.False(TriangleBoxTest.Meets(Unit, other, Math.BitDecrement(0.5)));
            Assert.False(TriangleBoxTest.Meets(other, Unit, 0));
            Assert.True(TriangleBoxTest.Meets(Unit, new(Unit.Minimum + axis, Unit.Maximum + axis), 0));
        }
    }

    private static Vector Draw(Random random, bool isGrid) =>
        isGrid ? new(random.Next(-2, 3), random.Next(-2, 3), random.Next(-2, 3)) : random.Vector(2);

    private static BoundingBox BoxOf(Vector corner1, Vector corner2) => new(Vector.Min(corner1, corner2), Vector.Max(corner1, corner2));

    private static BoundingBox Grown(BoundingBox box, double margin) =>
        new(box.Minimum - (margin * Vector.One), box.Maximum + (margin * Vector.One));

    /// <summary>Cuts a polygon at the six planes of a box, one after the other.</summary>
    private static bool IsAnythingLeft(List<Vector> polygon, BoundingBox box)
    {
        foreach (var axis in new[] { Vector.I, Vector.J, Vector.K })
        {
            polygon = Cut(polygon, axis, Vector.Dot(axis, box.Maximum));
            polygon = Cut(polygon, -axis, -Vector.Dot(axis, box.Minimum));
        }

        return polygon.Count > 0;
    }

    private static List<Vector> Cut(List<Vector> polygon, Vector normal, double offset)
    {
        List<Vector> kept = [];
        for (var i = 0; i < polygon.Count; i++)
        {
            var (start, end) = (polygon[i], polygon[(i + 1) % polygon.Count]);
            var (startHeight, endHeight) = (Vector.Dot(normal, start) - offset, Vector.Dot(normal, end) - offset);
            if (startHeight <= 0)
            {
                kept.Add(start);
            }

            if ((startHeight < 0 && endHeight > 0) || (startHeight > 0 && endHeight < 0))
            {
                kept.Add(start + (startHeight / (startHeight - endHeight) * (end - start)));
            }
        }

        return kept;
    }
}
