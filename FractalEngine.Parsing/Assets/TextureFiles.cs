using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Parsing.Assets.References;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Assets;

/// <summary>Finds the files of textures, and tests that they may be decoded.</summary>
/// <param name="references">Resolves the names of files.</param>
/// <param name="warnings">Receives the warnings.</param>
internal sealed class TextureFiles(FileReferenceResolver references, List<Diagnostic> warnings)
{
    // Beyond so many missing textures, one more message helps nobody.
    private const int MaxTextureWarnings = 20;

    // Whether each image file that was tested is usable.
    private readonly Dictionary<string, bool> _textureFiles = [];
    private readonly HashSet<(string Referrer, string File)> _reportedTextures = [];
    private long _totalPixels;
    private int _textureWarningCount;

    /// <summary>Total size of the images found so far, each counted once, in bytes.</summary>
    public long StorageBytes { get; private set; }

    /// <summary>Returns a texture with the full path of its image; null, with a warning of the consequence, if it can't be used.</summary>
    /// <param name="source">Text that names the image.</param>
    /// <param name="offset">Offset of the name.</param>
    /// <param name="referrer">Full path of the file with that text.</param>
    /// <param name="texture">Texture with the name as written.</param>
    /// <param name="consequence">What happens without it; null for an image that is never decoded, which needs no message.</param>
    public MaterialTexture? Find(SourceText source, int offset, string referrer, MaterialTexture texture, string? consequence)
    {
        var path = consequence is null
            ? references.FindForeign(referrer, texture.Path)
            : FindUsable(source, offset, referrer, texture.Path, consequence);
        return path is null ? null : texture with { Path = path };
    }

    /// <summary>Tells whether an image that is part of another file may be decoded; one that may not has a warning.</summary>
    /// <param name="texture">With the bytes of the image.</param>
    /// <param name="fileName">Name of the file with the image, for messages.</param>
    /// <param name="consequence">What happens without it; null for an image that is never decoded, which needs no message.</param>
    public bool IsUsable(MaterialTexture texture, string fileName, string? consequence)
    {
        var name = Path.GetFileName(texture.Path);
        if (!_textureFiles.TryGetValue(texture.Path, out var isUsable))
        {
            try
            {
                CheckImage(new(fileName, ""), 0, new MemoryStream([.. texture.Contents]), false, name);
                isUsable = true;
            }
            catch (SourceException fault)
            {
                warnings.Add(fault.Diagnostic with
                {
                    Severity = DiagnosticSeverity.Warning,
                    Message = $"{fault.Diagnostic.Message}: {consequence ?? "left out"}",
                });
            }

            _textureFiles[texture.Path] = isUsable;
        }

        return isUsable;
    }

    private string? FindUsable(SourceText source, int offset, string referrer, string file, string consequence)
    {
        if (_textureWarningCount >= MaxTextureWarnings && references.FindForeign(referrer, file) is null)
        {
            return null;
        }

        try
        {
            var (fullPath, _) = references.ResolveForeign(source, offset, referrer, file);
            if (!_textureFiles.TryGetValue(fullPath, out var isUsable))
            {
                _textureFiles[fullPath] = false;
                CheckTextureFile(source, offset, fullPath, file);
                isUsable = _textureFiles[fullPath] = true;
            }

            return isUsable ? fullPath : null;
        }
        catch (SourceException fault)
        {
            // Reported once per file, however many materials refer to it.
            if (_reportedTextures.Add((source.FileName, file)) && ++_textureWarningCount <= MaxTextureWarnings)
            {
                var suffix = _textureWarningCount < MaxTextureWarnings ? "" : "; further unusable textures are not reported";
                var message = $"{fault.Diagnostic.Message}: {consequence}{suffix}";
                warnings.Add(fault.Diagnostic with { Severity = DiagnosticSeverity.Warning, Message = message });
            }

            return null;
        }
    }

    private void CheckTextureFile(SourceText source, int offset, string fullPath, string file)
    {
        try
        {
            // Pipes and devices report a length of 0, and opening one may wait for ever.
            if (new FileInfo(fullPath).Length == 0)
            {
                throw source.Error(offset, $"\"{file}\" is empty, expected an image");
            }

            using var stream = new FileStream(fullPath, FileMode.Open, FileAccess.Read, FileShare.Read);
            CheckImage(source, offset, stream, ImageHeader.IsTga(fullPath), file);
            StorageBytes += stream.Length;
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException)
        {
            throw source.Error(offset, $"the image \"{file}\" can't be read: {exception.Message}");
        }
    }

    private void CheckImage(SourceText source, int offset, Stream stream, bool isTga, string file)
    {
        if (stream.Length > ParsingLimits.ImageBytes.Value)
        {
            throw source.Error(offset, $"the image \"{file}\" is larger than the limit of {ParsingLimits.ImageBytes.Value} bytes",
                isLimitExceeded: true);
        }

        if (ImageHeader.Read(stream, isTga) is not { Width: > 0 and var width, Height: > 0 and var height } header)
        {
            throw source.Error(offset, $"\"{file}\" is not a PNG, JPEG, BMP or TGA image");
        }

        if (Math.Max(width, height) > ParsingLimits.ImageSide.Value)
        {
            throw source.Error(offset,
                $"the image \"{file}\" has {width}×{height} pixels, more than the limit of {ParsingLimits.ImageSide.Value} per side",
                isLimitExceeded: true);
        }

        if (_totalPixels + (width * height) > ParsingLimits.TotalImagePixels.Value)
        {
            throw source.Error(offset,
                $"with \"{file}\" all images have more than the limit of {ParsingLimits.TotalImagePixels.Value} pixels",
                isLimitExceeded: true);
        }

        if (header.FindFault(stream.Length) is { } fault)
        {
            throw source.Error(offset, $"the image \"{file}\" {fault}");
        }

        _totalPixels += width * height;
    }
}
