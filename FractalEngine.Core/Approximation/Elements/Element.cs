namespace FractalEngine.Core.Approximation.Elements;

/// <summary>A connected part of a mesh, and the class of those that affine maps take to it.</summary>
/// <param name="shape">Its vertices.</param>
/// <param name="corners">Its faces, indices of the shape's vertices, [faces × 3].</param>
internal sealed class Element(ElementShape shape, int[] corners)
{
    /// <summary>The vertices of the element.</summary>
    public ElementShape Shape => shape;

    /// <summary>Indices of vertices from 0, [faces × 3].</summary>
    public int[] Corners => corners;

    /// <summary>The class of congruent elements, from 0.</summary>
    public int Class { get; set; }

    /// <summary>One of the maps that take the first element of the class to this one.</summary>
    public Maths.AffineMap Placement { get; set; } = Maths.AffineMap.Identity;
}
