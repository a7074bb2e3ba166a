using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Rows;

/// <summary>
/// Leaves out contacts of a capsule that others make superfluous: on a plane, both outer balls of its row hold all that lie in between.
/// </summary>
/// <remarks>With all of them, forces would be undetermined, and the solve would hardly converge.</remarks>
internal static class CapsuleRows
{
    // Squared difference of unit normals below which two planes are parallel.
    private const double SameNormal = 1e-16;

    // Relative to the radius: by how much a plane may lie lower than the line between two others and still be the same one.
    private const double SamePlane = 1e-9;

    /// <summary>Moves the contacts that are needed to the front, in their order.</summary>
    /// <param name="rows">Contacts of one capsule with surfaces.</param>
    /// <returns>Their number.</returns>
    public static int RemoveInner(Span<ContactRow> rows)
    {
        Span<bool> isInner = stackalloc bool[rows.Length];
        for (var i = 0; i < rows.Length; i++)
        {
            for (var j = 0; j < rows.Length && !isInner[i]; j++)
            {
                for (var k = 0; k < rows.Length && !isInner[i]; k++)
                {
                    isInner[i] = rows[j].FeatureId < rows[i].FeatureId && rows[k].FeatureId > rows[i].FeatureId
                        && IsBetween(in rows[i], in rows[j], in rows[k]);
                }
            }
        }

        var count = 0;
        for (var i = 0; i < rows.Length; i++)
        {
            if (!isInner[i])
            {
                rows[count++] = rows[i];
            }
        }

        return count;
    }

    private static bool IsBetween(in ContactRow row, in ContactRow lower, in ContactRow upper)
    {
        var share = (row.FeatureId - lower.FeatureId) / (double)(upper.FeatureId - lower.FeatureId);
        return !row.IsBall && !lower.IsBall && !upper.IsBall
            && (row.Normal - lower.Normal).LengthSquared() <= SameNormal && (row.Normal - upper.Normal).LengthSquared() <= SameNormal
            && Height(in row) >= ((1 - share) * Height(in lower)) + (share * Height(in upper)) - (SamePlane * row.FirstRadius);
    }

    private static double Height(in ContactRow row) => Vector.Dot(row.Offset, row.Normal);
}
