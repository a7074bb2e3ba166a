namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>The way in which the transformations along a chain of levels are composed.</summary>
public enum Composition
{
    /// <summary>One affine map after the other (paper §4.3.2: m·t); the default.</summary>
    Affine,

    /// <summary>Positions and rotations are added, scales multiplied, component by component (paper §4.2.4).</summary>
    Componentwise,
}
