using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Geometry.Surfaces;

/// <summary>Tests what edges tell of a surface against pairs of positions, looked up one by one.</summary>
public class SurfaceEdgesTests
{
    [Fact]
    public void Of_RandomMeshes_CountsPairsOfPositions()
    {
        var random = new Random(1);
        var (open, touching) = (0, 0);
        for (var round = 0; round < 300; round++)
        {
            // Few positions of many vertices: edges that many faces share, faces without area, and zeros of both signs.
            var positions = Enumerable.Range(0, 3 * random.Next(1, 30))
                .Select(_ => random.Next(-1, 2) * (random.Next(2) * 2.0 - 1)).ToArray();
            var indices = Enumerable.Range(0, 3 * random.Next(0, 40)).Select(_ => random.Next(positions.Length / 3)).ToArray();
            var mesh = new Mesh([.. positions], [.. indices]);
            var edges = SurfaceEdges.Of(mesh);

            Assert.Equal(CountByPositions(mesh), edges);
            (open, touching) = (open + edges.OpenCount, touching + edges.TouchingCount);
        }

        Assert.True(open > 1000 && touching > 100, $"{open} {touching}");
    }

    [Fact]
    public void Of_AFanAroundOneVertex_TakesALinearTime()
    {
        const int spokes = 300_000;
        double[] rim = [.. Enumerable.Range(0, spokes).SelectMany(i => new[] { Math.Cos(i), Math.Sin(i), 0 })];
        int[] faces = [.. Enumerable.Range(1, spokes - 1).SelectMany(i => new[] { 0, i, i + 1 })];
        Assert.Equal(spokes + 1, SurfaceEdges.Of(new([0, 0, 1, .. rim], [.. faces])).OpenCount);
    }

    private static SurfaceEdges CountByPositions(Mesh mesh)
    {
        var edges = Enumerable.Range(0, mesh.VertexIndices.Length)
            .Select(corner => (
                From: mesh.Vertex(mesh.VertexIndices[corner]),
                To: mesh.Vertex(mesh.VertexIndices[(3 * (corner / 3)) + ((corner + 1) % 3)])))
            .Where(edge => edge.From != edge.To).ToArray();
        var open = new HashSet<(Vector From, Vector To)>();
        var touching = new HashSet<(Vector From, Vector To)>();
        Vector? first = null;
        foreach (var (from, to) in edges)
        {
            var forth = edges.Count(edge => edge == (from, to));
            var back = edges.Count(edge => edge == (to, from));
            var set = forth != back ? open : forth + back > 2 ? touching : [];
            first ??= forth != back ? 0.5 * (from + to) : null;
            if (!set.Contains((to, from)))
            {
                set.Add((from, to));
            }
        }

        return new(open.Count, touching.Count, first);
    }
}
