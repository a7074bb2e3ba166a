namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>The kinds of meshes for which a search must end with a file or with an error that says what is wrong.</summary>
internal enum BadInputKind
{
    /// <summary>A mesh without vertices.</summary>
    Empty,

    /// <summary>Vertices without any face.</summary>
    NoFaces,

    /// <summary>One single triangle alone.</summary>
    OneTriangle,

    /// <summary>Faces without area: corners that are equal, or in one line.</summary>
    AllDegenerate,

    /// <summary>A million triangles of which no two share a vertex or a shape.</summary>
    SeparateTriangles,

    /// <summary>Long faces between random vertices, which pass through each other.</summary>
    SelfIntersecting,

    /// <summary>A good shape with one vertex 10¹⁴ away.</summary>
    FarVertex,

    /// <summary>Each part of a shape many times at the same place.</summary>
    CoincidentDuplicates,

    /// <summary>Triangles a million times as long as wide.</summary>
    Slivers,

    /// <summary>Random triangles in one plane, which leans.</summary>
    OnePlane,

    /// <summary>Faces whose vertices all lie on one line.</summary>
    OneLine,

    /// <summary>All vertices at one point.</summary>
    OnePoint,

    /// <summary>A good shape of size 10⁻¹² around the place (1, 1, 1).</summary>
    TinyAndFar,

    /// <summary>A good shape with coordinates of 10¹⁴⁰.</summary>
    Huge,

    /// <summary>A good shape with more vertices that no face uses than it has itself, far around it.</summary>
    UnusedVertices,
}
