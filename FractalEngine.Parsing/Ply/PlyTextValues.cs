using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Ply;

/// <summary>Reads numbers that are written as text.</summary>
internal sealed class PlyTextValues(MeshBytes bytes, int start) : PlyValues
{
    private readonly MeshTextReader _text = new(bytes) { Position = start };

    /// <inheritdoc/>
    public override long RemainingBytes => bytes.Length - _text.Position;

    /// <inheritdoc/>
    public override double Read(PlyType type) => _text.ReadNumber();

    /// <inheritdoc/>
    /// <remarks>A digit; the blank behind it may be missing at the end of the file.</remarks>
    public override int MinSize(PlyType type) => 1;

    /// <inheritdoc/>
    public override SourceException Error(string message, bool isLimitExceeded = false) => _text.Error(message, isLimitExceeded);
}
