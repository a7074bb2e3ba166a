using FractalEngine.Core;
using FractalEngine.Core.Approximation;
using FractalEngine.Core.Approximation.Damaged;
using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Approximation.Symmetries;
using FractalEngine.Core.Distances;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Wavefront.Writing;

namespace FractalEngine.Parsing.Approximation;

/// <summary>Finds a fractal for a mesh, and measures it on its files as they are read back (paper §6.2).</summary>
public sealed class MeshApproximator
{
    // Vertices and surfaces within this part of the diagonal count as the same.
    private const double ExactTolerance = 1e-6;

    // To show that two faces are the same takes about one division, of some 300 bytes: more would take more than there is.
    private const int MinDivisions = 500_000;
    private const int MaxDivisions = 4_000_000;

    // What leaves more of the faces is a list of what the mesh consists of.
    private const double MaxShareLeft = 0.75;

    // What only approximates must take so much less than what is exact.
    private const double ClearlyLess = 0.75;

    // Where elements are missing in the mesh, a fractal has more faces than it.
    private const int MaxGrowth = 16;

    // A vertex with its faces in a file: what each costs that an approximate fractal does not make.
    private const long VertexBytes = 60;

    // A fractal that has so many times as many of the mesh's vertices as the simplified mesh has in all is closer to it.
    private const int MinGain = 4;

    // Unless it reaches so far beyond the mesh, or the mesh beyond it, in diagonals.
    private const double MaxReach = 0.5;

    // Simplification moves open edges by so much of the diagonal at most, or they are others than those of a cut.
    private const double SeamTolerance = 0.002;

    private readonly Mesh _mesh;
    private readonly ApproximationSettings _settings;
    private readonly IProgress<ApproximationProgress>? _progress;
    private readonly CancellationToken _cancellation;
    private readonly double _length;
    private ApproximationResult? _best;

    private MeshApproximator(
        Mesh mesh, ApproximationSettings settings, IProgress<ApproximationProgress>? progress, CancellationToken cancellation)
    {
        _mesh = mesh;
        _settings = settings;
        _progress = progress;
        _cancellation = cancellation;
        _length = mesh.UsedBounds.Diagonal;
    }

    /// <summary>
    /// Looks for what makes a mesh exactly or was damaged, and then for what is closer to it than a simplified mesh of as many bytes.
    /// </summary>
    /// <param name="mesh">A mesh with at least one face.</param>
    /// <param name="settings">What the fractal may cost; null for anything.</param>
    /// <param name="progress">Receives what is done, and the best result so far, on the calling thread; null for nothing.</param>
    /// <param name="cancellation">Ends the search; what was found by then has been reported.</param>
    /// <exception cref="ArgumentException">The mesh has no faces.</exception>
    /// <exception cref="OperationCanceledException">The search was cancelled.</exception>
    /// <remarks>The same mesh gives the same result, on any number of threads.</remarks>
    public static ApproximationResult Find(
        Mesh mesh, ApproximationSettings? settings = null, IProgress<ApproximationProgress>? progress = null,
        CancellationToken cancellation = default)
    {
        ArgumentNullException.ThrowIfNull(mesh);
        if (mesh.FaceCount == 0)
        {
            throw new ArgumentException("expected a mesh with at least one face", nameof(mesh));
        }

        return new MeshApproximator(mesh, settings ?? new(), progress, cancellation).Find();
    }

    private ApproximationResult Find()
    {
        Report("what makes all faces exactly");
        var exact = GrammarSearch.FindExact(_mesh, _cancellation) is { } grammar ? JudgeExact(grammar) : null;
        // Otherwise it may be a damaged fractal, of which it lists what is left.
        if (exact?.Grammar.ExplainsMost(_mesh.FaceCount) == true)
        {
            return exact;
        }

        _best = exact;
        Report("what makes most faces, if some are moved, missing or foreign");
        var settings = new DamagedSearchSettings(_settings.Tolerance * _length, _settings.Seed, _settings.Effort);
        if (DamagedSearch.Find(_mesh, settings, _cancellation) is { } damaged
            && Judge(damaged) is { Verdict: ApproximationVerdict.Approximate } approximate
            && (exact is null || approximate.Bytes + (VertexBytes * MissingIn(approximate)) < ClearlyLess * exact.Bytes))
        {
            return approximate;
        }

        if (exact is not null)
        {
            return exact;
        }

        var bytes = _settings.MaxBytes ?? ApproximationSettings.DefaultBytes;
        if (8L * _mesh.FaceCount > bytes || ObjBytes(_mesh) > bytes)
        {
            Report("a plane that mirrors the shape");
            var plane = MirrorSearch.Find(_mesh, _cancellation);
            foreach (var side in new[] { plane, plane with { Normal = -plane.Normal, Offset = -plane.Offset } })
            {
                Report("the half whose mirror image is closest");
                if (FindMirrored(side, bytes) is { } found && !(found.Distance.MeanDistance >= _best?.Distance.MeanDistance))
                {
                    _best = found;
                }
            }
        }

        return _best is { Verdict: ApproximationVerdict.Approximate } ? _best : Simplify(bytes);
    }

    private void Report(string stage) => _progress?.Report(new(stage, _best));

    /// <summary>Measures what may be exact; null where it is not, leaves most faces, or is larger than wanted.</summary>
    private ApproximationResult? JudgeExact(MeshGrammar grammar)
    {
        if (grammar.FaceCount > MaxShareLeft * _mesh.FaceCount
            || Write(grammar, 2L * _mesh.FaceCount) is not { } written
            || VertexDistance.FindLargest(_mesh, written.Mesh, ExactTolerance * _length) is not { } vertices)
        {
            return null;
        }

        // Below half of the tolerance there is nothing to distinguish.
        var settings = new SurfaceDistanceSettings
        {
            Resolution = 0.5 * ExactTolerance,
            MaxDivisions = Math.Clamp(2 * _mesh.FaceCount, MinDivisions, MaxDivisions),
        };
        var distance = SurfaceDistance.Between(_mesh, written.Mesh, settings, _cancellation);
        return distance.MaxDistance.Upper > ExactTolerance * _length
            ? null
            : new(
                grammar.IsRecursive ? ApproximationVerdict.Exact : ApproximationVerdict.Repeats, grammar, written.Mesh, written.Bytes,
                distance, vertices, null, null);
    }

    /// <summary>Compares a fractal with the simplified mesh of as many bytes; null where it is larger than wanted.</summary>
    private ApproximationResult? Judge(MeshGrammar grammar)
    {
        if (Write(grammar, MaxGrowth * (long)_mesh.FaceCount) is not { } written)
        {
            return null;
        }

        var distance = SurfaceDistance.Between(_mesh, written.Mesh, cancellation: _cancellation);
        var simple = new SameBytesMesh(_mesh, simple => simple, _cancellation).Find(written.Bytes, ObjBytes);
        var simpleDistance = simple is null ? null : SurfaceDistance.Between(_mesh, simple, cancellation: _cancellation);
        // Where elements are missing or foreign, distances don't tell what is explained.
        var matching = VertexDistance.CountWithin(_mesh, written.Mesh, ExactTolerance * _length);
        var isBetter = simpleDistance is null
            || (matching.Near > MinGain * simple!.VertexCount && distance.RelativeMaxDistance.Upper < MaxReach)
            || distance.MeanDistance + distance.MeanDistanceError < simpleDistance.MeanDistance - simpleDistance.MeanDistanceError;
        return new(
            isBetter ? ApproximationVerdict.Approximate : ApproximationVerdict.NoFractal, grammar, written.Mesh, written.Bytes, distance,
            null, matching, simple is null ? null : (simple, simpleDistance!));
    }

    private static int MissingIn(ApproximationResult result) =>
        result.MatchingVertices is { } vertices ? vertices.All - vertices.Near : 0;

    /// <summary>Half of the shape, simplified, and its mirror image.</summary>
    private ApproximationResult? FindMirrored(MirrorPlane plane, long bytes)
    {
        var half = plane.HalfOf(_mesh);
        return half.FaceCount > 0
            && new SameBytesMesh(half, simple => plane.WithClosedSeam(simple, SeamTolerance * _length), _cancellation)
                .Find(bytes, mesh => BytesOf(Mirrored(mesh))) is { } found
            ? Judge(Mirrored(found))
            : null;

        MeshGrammar Mirrored(Mesh mesh) => new([new([[AffineMap.Identity, plane.Reflection]], 1)], null, mesh, null);
    }

    /// <summary>The simplified mesh, where no fractal is better.</summary>
    private ApproximationResult Simplify(long bytes)
    {
        Report("the simplified mesh");
        var simple = new SameBytesMesh(_mesh, simple => simple, _cancellation).Find(bytes, mesh => BytesOf(Alone(mesh)))
            ?? throw new FractalEngineException(ErrorKind.Limit, FormattableString.Invariant(
                $"no mesh with a face has only {bytes} bytes, so there is nothing to write"));
        var written = WrittenGrammar.Create(Alone(simple), _length, long.MaxValue);
        var distance = SurfaceDistance.Between(_mesh, written.Mesh, cancellation: _cancellation);
        return new(ApproximationVerdict.NoFractal, Alone(simple), written.Mesh, written.Bytes, distance, null, null,
            (simple, distance));

        static MeshGrammar Alone(Mesh mesh) => new([], null, mesh, null);
    }

    private long BytesOf(MeshGrammar grammar) => WrittenGrammar.Create(grammar, _length, long.MaxValue).Bytes;

    /// <summary>Writes and reads a grammar; null where the language refuses it, or it has more maps, bytes or faces than wanted.</summary>
    private WrittenGrammar? Write(MeshGrammar grammar, long maxFaces)
    {
        _cancellation.ThrowIfCancellationRequested();
        if (grammar.MapCount > (_settings.MaxMaps ?? int.MaxValue))
        {
            return null;
        }

        try
        {
            var written = WrittenGrammar.Create(grammar, _length, maxFaces);
            return written.Bytes <= (_settings.MaxBytes ?? long.MaxValue) && written.Mesh.FaceCount > 0 ? written : null;
        }
        catch (FractalEngineException)
        {
            return null;
        }
    }

    private static long ObjBytes(Mesh mesh)
    {
        using var stream = new MemoryStream();
        ObjMeshWriter.Write(mesh, stream);
        return stream.Length;
    }
}
