using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Distances;

/// <summary>Measures how far the points of one surface are from another one.</summary>
/// <param name="mesh">The surface, with a face.</param>
/// <param name="target">The surface that distances are measured to.</param>
/// <param name="settings">How exact, and what it may cost.</param>
/// <param name="loop">The threads.</param>
internal sealed class OneSidedMeasurement(Mesh mesh, TargetSurface target, SurfaceDistanceSettings settings, BlockLoop loop)
{
    private readonly SurfacePoint[] _vertices = new SurfacePoint[mesh.VertexCount];

    /// <summary>Measures all of the surface.</summary>
    /// <param name="resolution">Difference of the bounds at which the search ends in any case, scene units.</param>
    /// <param name="rounding">Upper bound of the rounding error of a distance, scene units.</param>
    public OneSidedDistance Run(double resolution, double rounding)
    {
        loop.For(mesh.VertexCount, MeasureVertices);
        var sampler = new FaceSampler(mesh, target, settings.Samples);
        var sums = loop.For(mesh.FaceCount, (start, end) => SampleFaces(sampler, start, end))
            .Aggregate((sums1, sums2) => sums1 + sums2);
        var search = new MaxDistanceSearch(target, loop, sums.Farthest, settings.Tolerance, resolution);
        search.Run(Enumerable.Range(0, mesh.FaceCount).Select(BoundFace), settings.MaxDivisions);
        var farthest = search.Farthest;
        var bounds = new DistanceInterval(Math.Max(0, farthest.Distance - rounding), search.UpperBound + rounding);
        return new(
            bounds,
            farthest.Position,
            target.ClosestPoint(farthest),
            Math.Min(bounds.Upper, sums.Distance / sums.Weight),
            sums.DistanceError / sums.Weight,
            Math.Min(Math.PI / 2, sums.Angle / sums.Weight));
    }

    private int MeasureVertices(int start, int end)
    {
        var hint = 0;
        for (var vertex = start; vertex < end; vertex++)
        {
            _vertices[vertex] = target.Measure(mesh.Vertex(vertex), hint);
            hint = _vertices[vertex].Face;
        }

        return end;
    }

    private SampleSums SampleFaces(FaceSampler sampler, int start, int end)
    {
        var sums = new SampleSums(Corner(3 * start), 0, 0, 0, 0);
        for (var face = start; face < end; face++)
        {
            sums += sampler.Sample(Corner(3 * face), Corner((3 * face) + 1), Corner((3 * face) + 2));
        }

        return sums;
    }

    /// <summary>Bounds the distance of a face by the best of the faces closest to its corners.</summary>
    private (SurfacePiece Piece, double UpperBound) BoundFace(int face)
    {
        var (a, b, c) = mesh.Face(face);
        var piece = new SurfacePiece([a, b, c]);
        return (piece, Enumerable.Range(3 * face, 3).Min(index => piece.UpperBound(target, Corner(index).Face)));
    }

    private SurfacePoint Corner(int index) => _vertices[mesh.VertexIndices[index]];
}
