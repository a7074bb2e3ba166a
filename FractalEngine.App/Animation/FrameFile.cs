using System.Text;
using FractalEngine.Core;
using FractalEngine.Core.Images;
using FractalEngine.Render.Images;

namespace FractalEngine.App.Animation;

/// <summary>Tells whether a frame of an earlier animation is whole.</summary>
internal static class FrameFile
{
    /// <summary>Returns false for an image that was cut, or can't be read.</summary>
    /// <remarks>A PNG or HDR image is decoded. Of an EXR image the length counts.</remarks>
    public static bool IsComplete(string path)
    {
        try
        {
            return Path.GetExtension(path).ToUpperInvariant() switch
            {
                ".EXR" => HasAllBlocks(path),
                ".HDR" => RadianceFile.Read(File.ReadAllBytes(path), ImageFile.MaxPixels) is not null,
                _ => ImageFile.Load(path) is not null,
            };
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException or FractalEngineException)
        {
            return false;
        }
    }

    /// <summary>Returns whether a file ends where its last block does ("OpenEXR File Layout").</summary>
    /// <exception cref="IOException">It ends before.</exception>
    private static bool HasAllBlocks(string path)
    {
        using var reader = new BinaryReader(File.OpenRead(path), Encoding.ASCII);
        var stream = reader.BaseStream;
        // Behind number and version there are attributes, each with a name, a type and a length; an empty name ends them.
        stream.Seek(2 * sizeof(int), SeekOrigin.Begin);
        while (TextLength() > 0)
        {
            TextLength();
            // Forwards only, whatever a damaged file says.
            stream.Seek(reader.ReadUInt32(), SeekOrigin.Current);
        }

        // The first block stands behind the offsets of all blocks.
        stream.Seek(reader.ReadInt64() - sizeof(long), SeekOrigin.Begin);
        var last = reader.ReadInt64();
        stream.Seek(last + sizeof(int), SeekOrigin.Begin);
        return last + (2 * sizeof(int)) + reader.ReadInt32() == stream.Length;

        int TextLength()
        {
            var length = 0;
            while (reader.ReadByte() != 0)
            {
                length++;
            }

            return length;
        }
    }
}
