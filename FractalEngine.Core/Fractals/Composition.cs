namespace FractalEngine.Core.Fractals;

/// <summary>How the transformations along a chain of levels become one.</summary>
public enum Composition
{
    /// <summary>One affine map after the other (paper §4.3.2: m·t). The default.</summary>
    Affine,

    /// <summary>Positions and rotations added, scales multiplied, component by component (paper §4.2.4).</summary>
    Componentwise,
}
