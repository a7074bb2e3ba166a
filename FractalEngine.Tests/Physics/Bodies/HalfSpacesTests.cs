using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Bodies;

/// <summary>Projections onto intersections of half-spaces, against Dykstra's slow algorithm and by hand.</summary>
public sealed class HalfSpacesTests
{
    [Fact]
    public void TryProject_OntoRandomHalfSpaces_IsWhatDykstraConvergesTo() => Seeded.RunMost(2000, random =>
    {
        // All half-spaces contain one point, so that their intersection is not empty.
        var planes = new HalfSpaces();
        var interior = RandomVector(random);
        var count = random.Next(1, HalfSpaces.Capacity + 1);
        var normals = new Vector[count];
        var offsets = new double[count];
        for (var i = 0; i < count; i++)
        {
            normals[i] = RandomVector(random).UnitVector();
            offsets[i] = Vector.Dot(normals[i], interior) - random.NextDouble();
            planes.Add(normals[i], offsets[i]);
        }

        var target = 3 * RandomVector(random);
        Assert.True(planes.TryProject(target, out var closest));
        for (var i = 0; i < count; i++)
        {
            Assert.True(Vector.Dot(normals[i], closest) >= offsets[i] - 1e-12);
        }

        // Dykstra's projections converge to it, slowly where planes meet at sharp angles. What they still violate may bring them closer.
        var other = ProjectByDykstra(target, normals, offsets);
        var violation = Enumerable.Range(0, count).Max(i => Math.Max(0, offsets[i] - Vector.Dot(normals[i], other)));
        Assert.True((closest - target).Length() <= (other - target).Length() + 1e-6 + (100 * violation),
            $"{closest} is farther than {other}");
        // Where it has not converged, the comparison says little.
        return violation < 1e-6;
    }, minShare: 0.99);

    [Fact]
    public void TryProject_OntoHalfSpacesThatExcludeEachOther_IsFalse()
    {
        var planes = new HalfSpaces();
        planes.Add(Vector.I, 1);
        planes.Add(-Vector.I, 1);
        Assert.False(planes.TryProject(Vector.Zero, out var closest));
        Assert.Equal(Vector.Zero, closest);
    }

    [Fact]
    public void TryProject_BelowACornerOfThree_IsTheCorner()
    {
        var planes = new HalfSpaces();
        planes.Add(Vector.I, 1);
        planes.Add(Vector.J, 2);
        planes.Add(Vector.K, 3);
        Assert.True(planes.TryProject(Vector.Zero, out var closest));
        Assert.Equal(new(1, 2, 3), closest);
    }

    private static Vector ProjectByDykstra(Vector target, Vector[] normals, double[] offsets)
    {
        var point = target;
        var corrections = new Vector[normals.Length];
        for (var round = 0; round < 4000; round++)
        {
            var i = round % normals.Length;
            var shifted = point + corrections[i];
            var missing = Math.Max(0, offsets[i] - Vector.Dot(normals[i], shifted));
            point = shifted + (missing * normals[i]);
            corrections[i] = -missing * normals[i];
        }

        return point;
    }

    private static Vector RandomVector(Random random) =>
        new(random.NextDouble() - 0.5, random.NextDouble() - 0.5, random.NextDouble() - 0.5);
}
