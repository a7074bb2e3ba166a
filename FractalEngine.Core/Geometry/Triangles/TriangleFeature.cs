namespace FractalEngine.Core.Geometry.Triangles;

/// <summary>The part of a triangle that is closest to a position.</summary>
public enum TriangleFeature
{
    /// <summary>The interior of the triangle.</summary>
    Interior,

    /// <summary>The edge from the first to the second vertex.</summary>
    EdgeAB,

    /// <summary>The edge from the second to the third vertex.</summary>
    EdgeBC,

    /// <summary>The edge from the third to the first vertex.</summary>
    EdgeCA,

    /// <summary>The first vertex of the triangle.</summary>
    VertexA,

    /// <summary>The second vertex of the triangle.</summary>
    VertexB,

    /// <summary>The third vertex of the triangle.</summary>
    VertexC,
}
