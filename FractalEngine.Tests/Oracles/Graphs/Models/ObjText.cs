using System.Globalization;
using System.Text;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Oracles.Graphs.Models;

/// <summary>Writes meshes as Wavefront text.</summary>
internal static class ObjText
{
    public static string Of(OracleMesh mesh, bool hasNormals)
    {
        StringBuilder text = new();
        foreach (var vertex in mesh.Vertices)
        {
            AppendLine(text, "v", vertex);
        }

        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (i, j, k) = (mesh.Indices[3 * face], mesh.Indices[(3 * face) + 1], mesh.Indices[(3 * face) + 2]);
            if (hasNormals)
            {
                AppendLine(text, "vn", Vector.Cross(mesh.Vertices[j] - mesh.Vertices[i], mesh.Vertices[k] - mesh.Vertices[i]));
                text.Append(CultureInfo.InvariantCulture, $"f {i + 1}//{face + 1} {j + 1}//{face + 1} {k + 1}//{face + 1}\n");
            }
            else
            {
                text.Append(CultureInfo.InvariantCulture, $"f {i + 1} {j + 1} {k + 1}\n");
            }
        }

        return text.ToString();
    }

    /// <summary>Appends a keyword and three numbers, all digits of them.</summary>
    public static void AppendLine(StringBuilder text, string keyword, Vector v) =>
        text.Append(CultureInfo.InvariantCulture, $"{keyword} {v.X:R} {v.Y:R} {v.Z:R}\n");
}
