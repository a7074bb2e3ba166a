namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>The kinds of fractals that are expanded and given to the search as plain meshes.</summary>
internal enum FractalKind
{
    /// <summary>All words of length up to n of contracting similarities: the set has the identity.</summary>
    TreeWithIdentity,

    /// <summary>All words of length n exactly of contracting similarities: what stands at the ends.</summary>
    Leaves,

    /// <summary>As <see cref="TreeWithIdentity"/>, with unequal scales, shears and mirrors.</summary>
    SkewedTree,

    /// <summary>As <see cref="Leaves"/>, with unequal scales, shears and mirrors.</summary>
    SkewedLeaves,

    /// <summary>Maps that differ by translations only: gratings, Cantor sets, sponges, and what touches at corners.</summary>
    EqualMaps,

    /// <summary>Two sets: (A·B)ⁿ, or Aⁿ·Bᵐ.</summary>
    TwoSets,

    /// <summary>Two recursives of which one calls the other: a = m1(a) + m2(b) + base, b = m3(b) + base.</summary>
    Chain,

    /// <summary>Two or three recursives that call each other in turn: a = m1(a) + m2(b) + base, b = m3(a) + base.</summary>
    Ring,

    /// <summary>Products of rows, circles and helices, mostly of a small fractal.</summary>
    Tile,
}
