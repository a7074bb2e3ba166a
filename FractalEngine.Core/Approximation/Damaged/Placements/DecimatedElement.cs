using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Damaged.Placements;

/// <summary>An element whose faces may be fewer than those of the element that it is an image of.</summary>
internal sealed class DecimatedElement
{
    // Faces that meet so flatly fix no map, in units of the element's volume.
    private const double MinVolume = 1e-3;

    /// <param name="element">An element that is not flat.</param>
    public DecimatedElement(Element element)
    {
        (Shape, Corners) = (element.Shape, element.Corners);
        Volume = Math.Sqrt(1 / Shape.Inverse.Determinant());
        Frames = [.. new ElementTopology(Corners, Shape.Points.Length).PairsOfFaces().Where(frame => VolumeOf(frame) > MinVolume * Volume)];
    }

    /// <summary>The vertices of the element.</summary>
    public ElementShape Shape { get; }

    /// <summary>Indices of vertices, [faces × 3].</summary>
    public int[] Corners { get; }

    /// <summary>The root of the determinant of the vertices' covariance, cubic scene units.</summary>
    public double Volume { get; }

    /// <summary>The vertices of two faces that meet at an edge and don't lie in one plane: those of the edge, and the others.</summary>
    public (int A, int B, int C, int D)[] Frames { get; }

    private double VolumeOf((int A, int B, int C, int D) frame) => Math.Abs(new Matrix(
        Shape.Points[frame.B] - Shape.Points[frame.A], Shape.Points[frame.C] - Shape.Points[frame.A],
        Shape.Points[frame.D] - Shape.Points[frame.A]).Determinant());
}
