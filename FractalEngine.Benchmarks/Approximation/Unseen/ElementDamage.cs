using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Removes elements of a model, and adds elements of the same bases where none belongs.</summary>
internal static class ElementDamage
{
    /// <summary>
    /// Removes a fraction of the elements, which are no ends, and adds strangers. Both numbers are rounded to the closest integer.
    /// </summary>
    public static Mesh Replace(UnseenInput input, double missing, double strangers, SeededRandom random)
    {
        var count = input.ElementCount;
        // What is removed first is what comes first: the ends come last.
        var kept = random.Permutation(count).OrderBy(input.Ends.Contains).Skip(CountOf(count, missing)).Order();
        var positions = new List<Vector>(MeshTools.Positions(input.Clean));
        var indices = new List<int>();
        foreach (var element in kept.Select(index => input.Elements[index]))
        {
            for (var i = 3 * element.FirstFace; i < 3 * (element.FirstFace + element.FaceCount); i++)
            {
                indices.Add(input.Clean.VertexIndices[i]);
            }
        }

        for (var i = 0; i < CountOf(count, strangers); i++)
        {
            // As often of each base as there are elements of it.
            var model = input.Elements[random.Index(count)];
            var size = UnseenInput.BoundsOf(input.Clean, model).Diagonal;
            var stranger = PlaceStranger(input.Bases[model.Base], size, input.Clean.Bounds, random);
            indices.AddRange(stranger.VertexIndices.Select(vertex => positions.Count + vertex));
            positions.AddRange(MeshTools.Positions(stranger));
        }

        return MeshTools.TakeFaces(positions, indices);
    }

    /// <summary>Computes how many elements a fraction of them is.</summary>
    public static int CountOf(int elements, double fraction) => (int)Math.Round(fraction * elements);

    /// <summary>Places a mesh within bounds: about as large as an element is, turned and skewed by chance.</summary>
    private static Mesh PlaceStranger(Mesh part, double size, BoundingBox bounds, SeededRandom random)
    {
        var stretch = new Vector(random.Between(0.6, 1.4), random.Between(0.6, 1.4), random.Between(0.6, 1.4));
        var linear = random.GenericRotation() * (Matrix.Diagonal(stretch) * random.GenericRotation());
        var turned = MeshTools.Move(part, new(size * random.Between(0.7, 1.4) / part.Bounds.Diagonal * linear, Vector.Zero));
        // What is larger than the bounds along an axis begins where they do.
        var room = Vector.Max(bounds.Size - turned.Bounds.Size, Vector.Zero);
        var place = bounds.Minimum + room.Stretch(new(random.Fraction(), random.Fraction(), random.Fraction()));
        return MeshTools.Move(turned, AffineMap.Translate(place - turned.Bounds.Minimum));
    }
}
