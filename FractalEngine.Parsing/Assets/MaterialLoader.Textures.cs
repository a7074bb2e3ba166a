using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Assets;

/// <content>Finds the files of textures, and tests that they may be decoded.</content>
internal sealed partial class MaterialLoader
{
    /// <summary>Returns a texture with its full path; null if there is none. Never decoded, a missing file needs no message.</summary>
    private MaterialTexture? FindUnshownTexture(MaterialTexture? texture, string fullPath) =>
        texture is not null && references.FindForeign(fullPath, texture.Path) is { } path ? texture with { Path = path } : null;

    /// <summary>Returns the full path of an image, or null, with a warning about the consequence, if it can't be used.</summary>
    private string? FindTextureFile(SourceText source, int offset, string referrer, string file, string consequence)
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
                Warn(fault.Diagnostic with { Message = $"{fault.Diagnostic.Message}: {consequence}{suffix}" });
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
            if (stream.Length > ParsingLimits.MaxImageBytes)
            {
                throw source.Error(offset, $"the image \"{file}\" is larger than the limit of {ParsingLimits.MaxImageBytes} bytes",
                    isLimitExceeded: true);
            }

            var isTga = ImageHeader.IsTga(fullPath);
            if (ImageHeader.Read(stream, isTga) is not { Width: > 0 and var width, Height: > 0 and var height } header)
            {
                throw source.Error(offset, $"\"{file}\" is not a PNG, JPEG, BMP or TGA image");
            }

            if (Math.Max(width, height) > ParsingLimits.MaxImageSide)
            {
                throw source.Error(offset,
                    $"the image \"{file}\" has {width}×{height} pixels, more than the limit of {ParsingLimits.MaxImageSide} per side",
                    isLimitExceeded: true);
            }

            if (_totalPixels + (width * height) > ParsingLimits.MaxTotalImagePixels)
            {
                throw source.Error(offset,
                    $"with \"{file}\" all images have more than the limit of {ParsingLimits.MaxTotalImagePixels} pixels",
                    isLimitExceeded: true);
            }

            if (header.FindFault(stream.Length) is { } fault)
            {
                throw source.Error(offset, $"the image \"{file}\" {fault}");
            }

            _totalPixels += width * height;
            StorageBytes += stream.Length;
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException)
        {
            throw source.Error(offset, $"the image \"{file}\" can't be read: {exception.Message}");
        }
    }
}
