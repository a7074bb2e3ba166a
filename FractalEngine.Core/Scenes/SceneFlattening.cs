using System.Collections.Immutable;
using System.Globalization;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes;

/// <summary>Makes one mesh of placed objects, in world space.</summary>
public static class SceneFlattening
{
    /// <summary>Expands all objects to their faces.</summary>
    /// <param name="objects">Objects whose fractals are finite.</param>
    /// <param name="maxFaces">Maximum number of faces.</param>
    /// <returns>A mesh of positions and faces alone; mirrored instances are inside out.</returns>
    /// <exception cref="FractalLimitException">There are more faces. Nothing is expanded then.</exception>
    public static Mesh Flatten(this IEnumerable<PlacedModel> objects, long maxFaces)
    {
        var groups = new List<(Mesh Mesh, ImmutableArray<AffineMap> Instances)>();
        var faces = 0L;
        foreach (var part in objects.SelectMany(static placed => placed.Parts))
        {
            var mesh = part.Model.Mesh;
            var instances = part.Model is FractalModel { Fractal: var fractal }
                ? fractal.Expand((maxFaces - faces) / Math.Max(1, mesh.FaceCount))
                : [AffineMap.Identity];
            faces += instances.Length * (long)mesh.FaceCount;
            if (faces > maxFaces)
            {
                throw new FractalLimitException(string.Create(
                    CultureInfo.InvariantCulture, $"{part.Model.Name} has more faces than the limit of {maxFaces}"));
            }

            groups.Add((mesh, [.. instances.Select(map => part.ObjectToWorld * map)]));
        }

        return FractalGenerator.Flatten([.. groups]);
    }
}
