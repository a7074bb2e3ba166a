using System.Collections.Immutable;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>A model as it was made, and the damaged mesh of it that a search is given.</summary>
/// <param name="Kind">The name of its kind: of <see cref="FractalKind"/>, <see cref="RepeatKind"/> or <see cref="OrganicKind"/>.</param>
/// <param name="Seed">The seed that its numbers come from.</param>
/// <param name="Description">One line on how it was made, and how it was damaged.</param>
/// <param name="Clean">
/// The whole model without damage. Fractals have vertices welded within each element alone; of elements that coincide there is one. Models
/// that repeat have welded vertices between their units, too.
/// </param>
/// <param name="Mesh">What the search is given: shuffled at least.</param>
/// <param name="Elements">The elements of <paramref name="Clean"/>, which together have all of its faces, in order.</param>
/// <param name="Bases">The meshes that the elements are images of, in the frame of the model.</param>
/// <param name="Ends">
/// Indices of elements that show where a repetition ends: nothing else tells of it, so that they are never missing. None in a fractal whose
/// levels shrink.
/// </param>
/// <param name="Generators">The maps that it was made by; none where it does not repeat.</param>
/// <param name="Depth">The number of levels, or the length of the longest words.</param>
/// <param name="CoincidentElements">How many elements were left out since an equal one stands in their place.</param>
internal sealed record UnseenInput(
    string Kind,
    int Seed,
    string Description,
    Mesh Clean,
    Mesh Mesh,
    ImmutableArray<UnseenElement> Elements,
    ImmutableArray<Mesh> Bases,
    ImmutableArray<int> Ends,
    ImmutableArray<Generator> Generators,
    int Depth,
    int CoincidentElements)
{
    /// <summary>The diagonal of the smallest box of an element, scene units.</summary>
    public double SmallestElement { get; } = Elements.IsEmpty ? 0 : Elements.Min(element => BoundsOf(Clean, element).Diagonal);

    /// <summary>The least altitude of a face: noise must be smaller than that to leave faces recognizable, scene units.</summary>
    public double SmallestAltitude { get; } = MeshTools.SmallestAltitude(Clean);

    /// <summary>The number of elements of the undamaged model.</summary>
    public int ElementCount => Elements.Length;

    /// <summary>How many faces the bases have together: what a file must hold at least, beside its maps.</summary>
    public int BaseFaces => Bases.Sum(mesh => mesh.FaceCount);

    /// <summary>Computes the box of an element of a mesh.</summary>
    public static BoundingBox BoundsOf(Mesh mesh, UnseenElement element)
    {
        var box = BoundingBox.Empty;
        for (var i = 3 * element.FirstFace; i < 3 * (element.FirstFace + element.FaceCount); i++)
        {
            box = box.Including(mesh.Vertex(mesh.VertexIndices[i]));
        }

        return box;
    }
}
