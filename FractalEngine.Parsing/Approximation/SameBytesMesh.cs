using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Simplification;

namespace FractalEngine.Parsing.Approximation;

/// <summary>Simplifies a mesh until its files have no more than some bytes: what one would send instead of a fractal.</summary>
/// <param name="mesh">The mesh.</param>
/// <param name="finish">Changes the simplified mesh before its numbers are rounded.</param>
/// <param name="cancellation">Ends the work early.</param>
internal sealed class SameBytesMesh(Mesh mesh, Func<Mesh, Mesh> finish, CancellationToken cancellation)
{
    private const int MaxAttempts = 6;

    // A face takes a line of three indices, and half of a vertex with three numbers.
    private const int TypicalBytesPerFace = 24;

    // A mesh that takes so much of the bytes is as good as one that takes all.
    private const double GoodShare = 0.98;

    // Of Math.Round.
    private const int MaxDigits = 15;

    /// <summary>Returns the mesh with most faces of those tried whose files fit.</summary>
    /// <param name="bytes">The most bytes of the files.</param>
    /// <param name="bytesOf">Measures the files of a mesh.</param>
    /// <returns>A mesh with short numbers, or null where none with a face fits.</returns>
    /// <remarks>
    /// Numbers are rounded to a fiftieth of the length of a typical edge, so that they take few bytes and the shape shows no difference.
    /// </remarks>
    public Mesh? Find(long bytes, Func<Mesh, long> bytesOf)
    {
        Mesh? best = null;
        var (count, tooMany) = (Math.Min(mesh.FaceCount, Math.Max(1, bytes / TypicalBytesPerFace)), mesh.FaceCount + 1L);
        for (var attempt = 0; attempt < MaxAttempts && count > (best?.FaceCount ?? 0) && count < tooMany; attempt++)
        {
            var simple = Rounded(finish(count == mesh.FaceCount ? mesh : QuadricSimplifier.Simplify(mesh, (int)count, cancellation)));
            if (simple.FaceCount == 0)
            {
                break;
            }

            var size = bytesOf(simple);
            if (size <= bytes && simple.FaceCount > (best?.FaceCount ?? 0))
            {
                best = simple;
                if (size >= GoodShare * bytes)
                {
                    break;
                }
            }
            else if (size > bytes)
            {
                tooMany = count;
            }

            count = Math.Min(tooMany - 1, Math.Max(1, (long)(count * 0.995 * bytes / size)));
        }

        return best;
    }

    /// <summary>Rounds coordinates to decimals that are fine for the number of faces; very small models stay as they are.</summary>
    private Mesh Rounded(Mesh simple)
    {
        var step = mesh.UsedBounds.Diagonal / (50 * Math.Sqrt(Math.Max(1, simple.FaceCount)));
        var digits = Math.Max(0, (int)Math.Ceiling(-Math.Log10(step)));
        return digits > MaxDigits
            ? simple
            : new([.. simple.Positions.Select(coordinate => Math.Round(coordinate, digits) + 0.0)], simple.VertexIndices);
    }
}
