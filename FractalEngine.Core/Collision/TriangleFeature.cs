
namespace FractalEngine.Core.Collision;

/// <summary>Which part of a face is nearest to a position.</summary>
public enum TriangleFeature
{
    /// <summary>The inside.</summary>
    Interior,

    /// <summary>The edge from the first to the second corner.</summary>
    EdgeAB,

    /// <summary>The edge from the second to the third corner.</summary>
    EdgeBC,

    /// <summary>The edge from the third to the first corner.</summary>
    EdgeCA,

    /// <summary>The first corner.</summary>
    VertexA,

    /// <summary>The second corner.</summary>
    VertexB,

    /// <summary>The third corner.</summary>
    VertexC,
}
