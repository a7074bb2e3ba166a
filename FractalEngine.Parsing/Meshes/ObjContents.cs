using System.Collections.Immutable;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Meshes;

/// <summary>What an OBJ file has declared so far, in the order of its lines.</summary>
internal sealed class ObjContents
{
    private readonly List<ObjBlock> _blocks = [];
    private readonly List<string> _materialLibraries = [];
    private readonly List<SourcePosition> _libraryPositions = [];
    private readonly HashSet<string> _knownLibraries = [];
    private readonly Dictionary<string, SourcePosition> _materialPositions = [];
    private int _unknownLineCount;
    private SourcePosition? _firstUnknownLine;
    private string _firstUnknownKeyword = "";
    private int _invalidIndexCount;
    private SourcePosition? _firstInvalidIndex;
    private string _firstInvalidIndexMessage = "";
    private int _shortFaceCount;
    private SourcePosition? _firstShortFace;
    private int _firstShortFaceSize;

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
        _unknownLineCount++;
        if (_firstUnknownLine is null)
        {
            _firstUnknownLine = position;
            _firstUnknownKeyword = keyword;
        }
    }

    /// <summary>Counts an index of a normal or texture coordinate that does not exist.</summary>
    public void AddInvalidIndex(SourcePosition position, string message)
    {
        _invalidIndexCount++;
        if (_firstInvalidIndex is null)
        {
            _firstInvalidIndex = position;
            _firstInvalidIndexMessage = message;
        }
    }

    /// <summary>Counts a face with fewer than three corners, which is skipped.</summary>
    public void AddShortFace(SourcePosition position, int cornerCount)
    {
        _shortFaceCount++;
        if (_firstShortFace is null)
        {
            _firstShortFace = position;
            _firstShortFaceSize = cornerCount;
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

    private ImmutableArray<Diagnostic> CreateWarnings()
    {
        var warnings = ImmutableArray.CreateBuilder<Diagnostic>();
        if (_firstUnknownLine is not null)
        {
            var totalNote = _unknownLineCount == 1 ? "" : $" ({_unknownLineCount} lines with unknown keywords in all)";
            var message = $"unknown keyword {_firstUnknownKeyword} skipped{totalNote}";
            warnings.Add(_firstUnknownLine.Diagnose(message, DiagnosticSeverity.Warning));
        }

        if (_firstInvalidIndex is not null)
        {
            var totalNote = _invalidIndexCount == 1 ? "" : $" ({_invalidIndexCount} such corners in all)";
            var message = $"{_firstInvalidIndexMessage}: the index is ignored{totalNote}";
            warnings.Add(_firstInvalidIndex.Diagnose(message, DiagnosticSeverity.Warning));
        }

        if (_firstShortFace is not null)
        {
            var totalNote = _shortFaceCount == 1 ? "" : $" ({_shortFaceCount} such faces in all)";
            var message = $"a face needs at least three corners, this one has {_firstShortFaceSize}: skipped{totalNote}";
            warnings.Add(_firstShortFace.Diagnose(message, DiagnosticSeverity.Warning));
        }

        return warnings.ToImmutable();
    }
}
