using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics.Descriptions;

/// <summary>
/// Computes the radius of a physics object (paper §4.3.3): the distance of its farthest vertex from the position of its matrix m.
/// </summary>
internal static class BodyRadius
{
    // Relative to the radius: fractals are searched until no remaining part can add more.
    private const double RelativeTolerance = 1e-13;
    private const int MaxNodes = 50_000;

    /// <summary>Computes the radius in scene units; 0 for a model without vertices.</summary>
    /// <returns>
    /// Exact for a mesh, and for a fractal to 1e-13 of the radius; an upper bound where 50,000 sub-fractals do not decide.
    /// </returns>
    public static double Compute(PlacedModel placed)
    {
        var linear = new AffineMap(placed.ObjectToWorld.Linear, Vector.Zero);
        return placed.Model switch
        {
            FractalModel { Fractal: { Description.Composition: Composition.Affine } fractal } =>
                Math.Max(0, new FarthestPointSearch(fractal.Hierarchy).Run(linear, new DistanceFromOrigin(), RelativeTolerance, MaxNodes)),
            FractalModel { Fractal: var fractal } => FractalGenerator.Expand(fractal, FractalLimits.DrawnInstances.Value)
                .Max(instance => MaxVertexDistance(fractal.BaseMesh, linear * instance)),
            _ => MaxVertexDistance(placed.Model.Mesh, linear),
        };
    }

    /// <summary>Measures the distance of points from the origin.</summary>
    private readonly struct DistanceFromOrigin : IPointMeasure
    {
        public double UpperBound(SubFractal subFractal, in AffineMap map) => MaxCornerDistance(subFractal.Box, in map, Vector.Zero);

        public double MaxOverVertices(Mesh mesh, in AffineMap map) => MaxVertexDistance(mesh, map);

        public (Vector Direction, double Offset)? Key(in AffineMap map) => null;
    }

    /// <summary>Largest distance of a mapped box's corners from a point.</summary>
    public static double MaxCornerDistance(BoundingBox box, in AffineMap map, Vector centre)
    {
        var maxDistance = 0.0;
        for (var corner = 0; corner < 8; corner++)
        {
            maxDistance = Math.Max(maxDistance, ((map * box.Corner(corner)) - centre).Length());
        }

        return maxDistance;
    }

    private static double MaxVertexDistance(Mesh mesh, AffineMap map)
    {
        var maxDistance = 0.0;
        for (var vertex = 0; vertex < mesh.VertexCount; vertex++)
        {
            maxDistance = Math.Max(maxDistance, (map * mesh.Vertex(vertex)).Length());
        }

        return maxDistance;
    }
}
