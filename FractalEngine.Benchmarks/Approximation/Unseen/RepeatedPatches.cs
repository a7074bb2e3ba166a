using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>A model of patches, its description and the steps from each to the next, before it is welded.</summary>
/// <param name="Patches">The patches that are placed.</param>
/// <param name="Places">Where they stand.</param>
/// <param name="Generators">The steps, by name.</param>
/// <param name="Ends">Indices of the places at which a repetition begins or ends.</param>
/// <param name="Formula">What repeats how often, on one line.</param>
internal sealed record RepeatedPatches(
    ImmutableArray<Mesh> Patches,
    ImmutableArray<PlacedPatch> Places,
    ImmutableArray<Generator> Generators,
    ImmutableArray<int> Ends,
    string Formula)
{
    /// <summary>Repeats a patch along the powers of one step.</summary>
    public static RepeatedPatches Along(Mesh patch, AffineMap step, int count, string name) => new(
        [patch],
        [.. Enumerable.Range(0, count).Select(i => new PlacedPatch(0, step.Power(i)))],
        [new("step", step)],
        [0, count - 1],
        FormattableString.Invariant($"{count} {name}, each the step of the last one"));

    /// <summary>Repeats a patch along the products of powers of two steps.</summary>
    public static RepeatedPatches Grid(Mesh patch, AffineMap step1, int count1, AffineMap step2, int count2, string name) => new(
        [patch],
        [
            .. from i in Enumerable.Range(0, count1)
               from j in Enumerable.Range(0, count2)
               select new PlacedPatch(0, step1.Power(i) * step2.Power(j)),
        ],
        [new("step1", step1), new("step2", step2)],
        [0, count2 - 1, (count1 - 1) * count2, (count1 * count2) - 1],
        FormattableString.Invariant($"{count1} by {count2} {name}"));

    /// <summary>Adds one further patch that stands once.</summary>
    public RepeatedPatches With(Mesh patch, AffineMap map) =>
        this with
        {
            Patches = Patches.Add(patch),
            Places = Places.Add(new(Patches.Length, map)),
            Ends = Ends.Add(Places.Length),
        };

    /// <summary>Places all patches in a frame and welds what lies at one place; each placed patch becomes an element.</summary>
    public UnseenInput Weld(AffineMap frame, string kind, int seed)
    {
        var (positions, indices, elements) = (new List<Vector>(), new List<int>(), new List<UnseenElement>());
        foreach (var (index, map) in Places)
        {
            var image = MeshTools.Move(Patches[index], frame * map);
            elements.Add(new(indices.Count / 3, image.FaceCount, index));
            indices.AddRange(image.VertexIndices.Select(vertex => positions.Count + vertex));
            positions.AddRange(MeshTools.Positions(image));
        }

        var diagonal = positions.Aggregate(BoundingBox.Empty, (box, position) => box.Including(position)).Diagonal;
        var places = Welding.FindPlaces(positions, ElementExpansion.RelativeTolerance * diagonal);
        var clean = MeshTools.TakeFaces(positions, [.. indices.Select(vertex => places[vertex])]);
        clean = MeshTools.SignedVolume(clean) < 0 ? MeshTools.TurnFaces(clean) : clean;
        var inverse = frame.Inverse();
        return new(
            kind, seed, FormattableString.Invariant($"{kind} {seed}: {Formula}; {elements.Count} elements, {clean.FaceCount} faces"),
            clean, clean, [.. elements], [.. Patches.Select(patch => MeshTools.Move(patch, frame))], Ends,
            [.. Generators.Select(generator => generator with { Map = frame * generator.Map * inverse })], 1, 0);
    }
}
