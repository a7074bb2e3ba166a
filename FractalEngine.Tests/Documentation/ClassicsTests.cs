using FractalEngine.Core.Fractals;
using FractalEngine.Parsing;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Documentation;

/// <summary>The classic designs of the manual have the numbers that follow from their definitions.</summary>
public class ClassicsTests
{
    [Theory]
    // Tips, branches and leaves.
    [InlineData("bush", 2187 + 3279 + 3891)]
    // Slabs of an arch, its arches, and theirs.
    [InlineData("arch", 41 * (1 + 7 + 49))]
    // Tubes of a cylinder and two balls.
    [InlineData("dragon", 3 << 10)]
    // Thirteen squares for each one, from the six of a cube.
    [InlineData("koch", 6 * 13 * 13 * 13)]
    [InlineData("jerusalem", (8 * 172) + (12 * 20))]
    [InlineData("vicsek", 7 * 7 * 7)]
    [InlineData("cantor", 8 * 8 * 8)]
    [InlineData("pythagoras", (1 << 10) - 1)]
    public void Classic_HasAsManyInstancesAsItsDefinition(string name, long count) =>
        Assert.Equal(count, DistinctInstances.Count(Read(name)));

    [Fact]
    public void Tree_OfContextFree_HasTheBoundsOfItsShortestAndLongestWays()
    {
        var tree = Read("context-tree");
        var range = tree.CountRange()!.Value;
        // Of all discs that shrink from 1 by 0.989 or 0.82 · 0.989 down to a quarter, and of forks at each of them.
        Assert.Equal((214, 143_359), (range.Least, range.Most));
        Assert.InRange((long)range.Expected!.Value, 5300, 5600);
        Assert.InRange((long)range.Exact!.Value, 214, 143_359);
        Assert.Equal(range.Exact, tree.WithSeed(3).CountRange()!.Value.Exact);
        Assert.NotEqual(range.Exact, tree.WithSeed(4).CountRange()!.Value.Exact);
    }

    private static Fractal Read(string name) => FractalFile.Read(Repository.Full($"assets/classics/{name}.fdo"));
}
