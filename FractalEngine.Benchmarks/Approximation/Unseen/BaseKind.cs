namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>The kinds of base meshes of which the unseen fractals are made.</summary>
internal enum BaseKind
{
    /// <summary>A convex solid of six corners without any symmetry.</summary>
    Wedge,

    /// <summary>A regular prism of three to eight sides.</summary>
    Prism,

    /// <summary>A tetrahedron, regular or not.</summary>
    Tetrahedron,

    /// <summary>A cube or another box.</summary>
    Box,

    /// <summary>An octahedron, stretched or with a crooked apex.</summary>
    Octahedron,

    /// <summary>A solid whose outline is an L.</summary>
    Angle,

    /// <summary>A thick star of four to seven points.</summary>
    Star,

    /// <summary>Two pyramids on the two sides of a star.</summary>
    Thistle,

    /// <summary>A solid whose outline is a cross with unequal arms.</summary>
    Cross,

    /// <summary>A tapered trunk of five to seven sides.</summary>
    Trunk,

    /// <summary>A ball of 320 faces, stretched or with bumps.</summary>
    Ball,

    /// <summary>A ring with a hole.</summary>
    Ring,

    /// <summary>An open shell: a part of a sphere.</summary>
    Dome,

    /// <summary>An open shell: a strip that is bent and twisted.</summary>
    Gutter,

    /// <summary>A leaf with a midrib; all of its vertices lie in one plane.</summary>
    Leaf,

    /// <summary>An irregular flat polygon.</summary>
    Plate,

    /// <summary>One single triangle alone.</summary>
    Triangle,

    /// <summary>A stick with an octahedron that does not touch it.</summary>
    TwoParts,

    /// <summary>Three solids of different sizes that do not touch each other.</summary>
    ThreeParts,
}
