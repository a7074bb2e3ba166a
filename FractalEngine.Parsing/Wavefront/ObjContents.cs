using System.Collections.Immutable;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Wavefront;

/// <summary>What an OBJ file has declared so far, in the order of its lines.</summary>
internal sealed class ObjContents
{
    private readonly List<ObjBlock> _blocks = [];
    private readonly List<string> _materialLibraries = [];
    private readonly List<SourcePosition> _libraryPositions = [];
    private readonly HashSet<string> _knownLibraries = [];
    private readonly Dictionary<string, SourcePosition> _materialPositions = [];
    private readonly RepeatedWarning _unknownLines = new("lines with unknown keywords");
    private readonly RepeatedWarning _invalidIndices = new("such corners");
    private readonly RepeatedWarning _shortFaces = new("such faces");

    /// <summary>Numbers of elements in all blocks so far.</summary>
    public ObjCounts Counts { get; private set; }

    /// <summary>Names and materials of faces.</summary>
    public ObjGroups Groups { get; } = new();

    /// <summary>Whether there is a vertex, face, group or material.</summary>
    public bool HasDeclaration { get; set; }

    /// <summary>Adds elements behind all others.</summary>
    public void Add(ObjBlock block)
    {
        block.Before = Counts;
        _blocks.Add(block);
        Counts += block.Counts;
    }

    /// <summary>Records the use of a material, whose first position counts.</summary>
    public void AddMaterial(string name, SourcePosition position) => _materialPositions.TryAdd(name, position);

    /// <summary>Adds a material file, unless its name is empty or was added before.</summary>
    public void AddMaterialLibrary(string file, SourcePosition position)
    {
        if (file.Length > 0 && _knownLibraries.Add(file))
        {
            _materialLibraries.Add(file);
            _libraryPositions.Add(position);
        }
    }

    /// <summary>Counts a line with an unknown keyword.</summary>
    public void AddUnknownLine(SourcePosition position, string keyword)
    {
        if (_unknownLines.CountsFirst())
        {
            _unknownLines.Describe(position, $"unknown keyword {keyword} skipped");
        }
    }

    /// <summary>Counts an index of a normal or texture coordinate that does not exist.</summary>
    public void AddInvalidIndex(SourcePosition position, string message)
    {
        if (_invalidIndices.CountsFirst())
        {
            _invalidIndices.Describe(position, $"{message}: the index is ignored");
        }
    }

    /// <summary>Counts a face with fewer than three corners, which is skipped.</summary>
    public void AddShortFace(SourcePosition position, int cornerCount)
    {
        if (_shortFaces.CountsFirst())
        {
            _shortFaces.Describe(position, $"a face needs at least three corners, this one has {cornerCount}: skipped");
        }
    }

    /// <summary>Creates the mesh of all that was added.</summary>
    /// <param name="threadCount">Number of threads that merge the blocks, at least one.</param>
    /// <param name="byteCount">Size of the file in bytes.</param>
    public ParsedObj Complete(int threadCount, long byteCount) =>
        new(ObjMeshAssembler.Assemble(_blocks, Counts, threadCount).WithGroups(Groups.Complete(Counts.Faces), [.. _materialLibraries]),
            CreateWarnings())
        {
            MaterialLibraryPositions = [.. _libraryPositions],
            MaterialPositions = _materialPositions,
            ByteCount = byteCount,
        };

    private ImmutableArray<Diagnostic> CreateWarnings() =>
        [.. new[] { _unknownLines, _invalidIndices, _shortFaces }.Select(static warning => warning.ToDiagnostic()).OfType<Diagnostic>()];

    /// <summary>A fault that many lines may have: one warning at the first of them tells their number.</summary>
    /// <param name="plural">What is counted.</param>
    private sealed class RepeatedWarning(string plural)
    {
        private int _count;
        private SourcePosition? _first;
        private string _message = "";

        /// <summary>Counts one more of the faults.</summary>
        /// <returns>True for the first, which needs a message.</returns>
        public bool CountsFirst() => _count++ == 0;

        public void Describe(SourcePosition position, string message) => (_first, _message) = (position, message);

        public Diagnostic? ToDiagnostic() =>
            _first?.Diagnose(_count == 1 ? _message : $"{_message} ({_count} {plural} in all)", DiagnosticSeverity.Warning);
    }
}
