using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation;

/// <summary>Recognizes the shapes that files of fractals name in place of a mesh, wherever and however large they stand.</summary>
public static class BaseShapeSearch
{
    // In units of the shape: nothing that the eye or a collider tells apart.
    private const double Tolerance = 1e-7;

    /// <summary>Finds the shape that an affine map takes to a mesh.</summary>
    /// <param name="mesh">One connected mesh; the winding of its faces plays no part.</param>
    /// <returns>Its name, and of the maps the one that turns and stretches least; null where no shape has the same faces.</returns>
    public static (string Name, AffineMap Map)? Find(Mesh mesh)
    {
        ArgumentNullException.ThrowIfNull(mesh);
        foreach (var name in BaseShapes.Names)
        {
            if (BaseShapes.TryFind(name, out var shape) && shape.FaceCount == mesh.FaceCount
                && ElementFinder.Find(shape, weldPositions: true) is [var from]
                && ElementFinder.Find(mesh, weldPositions: true) is [var to])
            {
                var faces = FacesOf(to.Corners, corner => corner);
                var maps = new ElementAlignment(from.Shape, Tolerance).FindMaps(to.Shape).Where(map =>
                {
                    var images = Array.ConvertAll(from.Shape.Points, point => NearestTo(map * point, to.Shape.Points));
                    return faces.SetEquals(FacesOf(from.Corners, corner => images[corner]));
                }).ToList();
                if (maps.Count > 0)
                {
                    return (name, maps.MinBy(map => Math.Round(Conjugation.Oddity(map), 9)));
                }
            }
        }

        return null;
    }

    private static HashSet<(int, int, int)> FacesOf(int[] corners, Func<int, int> vertexOf)
    {
        var faces = new HashSet<(int, int, int)>();
        for (var corner = 0; corner < corners.Length; corner += 3)
        {
            int[] vertices = [vertexOf(corners[corner]), vertexOf(corners[corner + 1]), vertexOf(corners[corner + 2])];
            Array.Sort(vertices);
            faces.Add((vertices[0], vertices[1], vertices[2]));
        }

        return faces;
    }

    private static int NearestTo(Vector position, Vector[] points) =>
        Enumerable.Range(0, points.Length).MinBy(index => (points[index] - position).LengthSquared());
}
