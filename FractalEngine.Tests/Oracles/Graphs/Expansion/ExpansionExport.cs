using System.Collections.Immutable;
using System.Globalization;
using System.Text;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Oracles.Graphs.Models;

namespace FractalEngine.Tests.Oracles.Graphs.Expansion;

/// <summary>Writes the expansion of a model as one Wavefront file.</summary>
internal static class ExpansionExport
{
    /// <summary>Writes all triangles of all instances, with flat normals.</summary>
    /// <remarks>
    /// Mirrored instances are wound the other way round, so that their fronts stay in front. What no triangle uses is left out.
    /// </remarks>
    public static string ToObj(ImmutableArray<PlacedMesh> instances)
    {
        StringBuilder text = new();
        var faces = 0;
        foreach (var (mesh, map, _) in instances)
        {
            var isMirrored = map.Determinant < 0;
            for (var face = 0; face < mesh.FaceCount; face++)
            {
                var (i, j, k) = (mesh.Indices[3 * face], mesh.Indices[(3 * face) + 1], mesh.Indices[(3 * face) + 2]);
                var (a, b, c) = (mesh.Vertices[i], mesh.Vertices[j], mesh.Vertices[k]);
                var normal = map.ApplyToNormal(Vector.Cross(b - a, c - a));
                ObjText.AppendLine(text, "v", map.Apply(a));
                ObjText.AppendLine(text, "v", map.Apply(isMirrored ? c : b));
                ObjText.AppendLine(text, "v", map.Apply(isMirrored ? b : c));
                // Cofactors turn a normal round where the map mirrors.
                ObjText.AppendLine(text, "vn", isMirrored ? -normal : normal);
                var (first, number) = ((3 * faces) + 1, faces + 1);
                text.Append(CultureInfo.InvariantCulture, $"f {first}//{number} {first + 1}//{number} {first + 2}//{number}\n");
                faces++;
            }
        }

        return text.ToString();
    }
}
