using System.Text.Json;
using System.Text.Json.Serialization;
using FractalEngine.Core.Distances;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Approximation;
using static System.FormattableString;

namespace FractalEngine.App.Approximation;

/// <summary>Says what was found for a mesh, for people and for programs.</summary>
/// <param name="mesh">The mesh.</param>
/// <param name="result">What was found, and measured.</param>
internal sealed class ApproximationText(Mesh mesh, ApproximationResult result)
{
    private static readonly JsonSerializerOptions JsonOptions = new()
    {
        WriteIndented = true,
        Converters = { new JsonStringEnumConverter(JsonNamingPolicy.CamelCase) },
    };

    /// <summary>How far the mesh and the fractal are apart, as parts of the diagonal.</summary>
    public string Distances => Describe(result.Distance);

    /// <summary>What was found, line by line.</summary>
    public IEnumerable<string> Lines()
    {
        var maps = result.Grammar.MapCount;
        var sizes = Invariant($"{result.Grammar.FaceCount} of {mesh.FaceCount} faces are left, with {maps} {(maps == 1 ? "map" : "maps")}");
        yield return result.Verdict switch
        {
            ApproximationVerdict.Exact => $"EXACT: {sizes}",
            ApproximationVerdict.Repeats => $"REPEATS: {sizes}",
            ApproximationVerdict.Approximate => Invariant($"APPROXIMATE: {sizes}, {result.Bytes} bytes"),
            _ => Invariant(
                $"NO FRACTAL: nothing is closer than the simplified mesh of {result.Grammar.FaceCount} faces, {result.Bytes} bytes"),
        };
        if (result.VertexDistance is { } vertices)
        {
            var (relative, max) = (vertices / result.Distance.Diagonal, result.Distance.RelativeMaxDistance.Upper);
            yield return Invariant($"vertices are within {relative:0.0e+0} of the diagonal, surfaces within {max:0.0e+0}");
            yield break;
        }

        yield return Distances;
        if (result is { Verdict: ApproximationVerdict.Approximate, SameBytes: { } simple, MatchingVertices: { } own })
        {
            yield return Invariant($"{own.Near} of {own.All} vertices are its own");
            yield return Invariant($"a simplified mesh of as many bytes ({simple.Mesh.FaceCount} faces): {Describe(simple.Distance)}");
        }
    }

    /// <summary>The same for programs: an object in JSON.</summary>
    /// <param name="end">What ended the search.</param>
    public string ToJson(ApproximationEnd end) => JsonSerializer.Serialize(
        new
        {
            verdict = result.Verdict,
            endedBy = end,
            faces = mesh.FaceCount,
            facesLeft = result.Grammar.FaceCount,
            facesMade = result.Made.FaceCount,
            maps = result.Grammar.MapCount,
            bytes = result.Bytes,
            diagonal = result.Distance.Diagonal,
            matchingVertices = result.MatchingVertices?.Near,
            maxVertexDistance = result.VertexDistance / result.Distance.Diagonal,
            distance = ValuesOf(result.Distance),
            sameBytesMesh = result.SameBytes is { } simple
                ? new { faces = simple.Mesh.FaceCount, distance = ValuesOf(simple.Distance) }
                : null,
        },
        JsonOptions);

    private static object ValuesOf(SurfaceDistance distance) => new
    {
        mean = distance.RelativeMeanDistance,
        meanError = distance.MeanDistanceError / distance.Diagonal,
        maxLower = distance.RelativeMaxDistance.Lower,
        maxUpper = distance.RelativeMaxDistance.Upper,
        normalDegrees = DegreesOf(distance),
    };

    private static string Describe(SurfaceDistance distance)
    {
        var max = distance.RelativeMaxDistance;
        var (mean, degrees) = (distance.RelativeMeanDistance, DegreesOf(distance));
        return Invariant(
            $"mean distance {mean:0.00000} of the diagonal, largest {max.Lower:0.0000} to {max.Upper:0.0000}, ")
            + Invariant($"normals {degrees:0.0}° apart");
    }

    private static double DegreesOf(SurfaceDistance distance) => 180 / Math.PI * distance.MeanNormalAngle;
}
