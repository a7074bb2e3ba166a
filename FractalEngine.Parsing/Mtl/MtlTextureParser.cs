using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Grammar;
using FractalEngine.Parsing.Text.Numbers;

namespace FractalEngine.Parsing.Mtl;

/// <summary>Parses the textures of material files: options, each with its arguments, then the name of an image file.</summary>
/// <param name="source">Text that is parsed.</param>
public abstract class MtlTextureParser(SourceText source) : Parser(source)
{
    /// <summary>Offset of the name of each texture. Equal textures differ by their places.</summary>
    private protected Dictionary<MaterialTexture, int> TextureNameOffsets { get; } = new(ReferenceEqualityComparer.Instance);

    /// <summary>Parses a texture, and records where its name is.</summary>
    private protected bool ParseTexture(Cursor cursor, out MaterialTexture texture)
    {
        texture = new("");
        var rest = cursor;
        while (rest.Current == '-')
        {
            if (!ParseTextureOption(rest, ref texture, out rest))
            {
                return false;
            }

            ParseBlanks(rest, out rest);
        }

        // Windows accepts both slashes, other systems only this one.
        var file = ReadRestOfLine(rest, out _).Replace('\\', '/');
        if (file.Length == 0)
        {
            return Fail(rest, "a file name");
        }

        texture = texture with { Path = file };
        TextureNameOffsets[texture] = rest.Offset;
        return true;
    }

    private bool ParseTextureOption(Cursor cursor, ref MaterialTexture texture, out Cursor rest)
    {
        rest = cursor;
        var length = cursor.Rest.IndexOfAny(" \t\r\n");
        var option = (length < 0 ? cursor.Rest : cursor.Rest[..length]).ToString();
        ParseBlanks(cursor.Advance(option.Length), out var arguments);
        return option switch
        {
            "-clamp" => ParseOnOff(arguments, out var isOn, out rest) && Set(ref texture, texture with { IsClamped = isOn }),
            "-blendu" or "-blendv" or "-cc" => ParseOnOff(arguments, out _, out rest),
            "-s" => ParseUpToThreeNumbers(arguments, Vector.One, out var scale, out rest)
                && Set(ref texture, texture with { Scale = (scale.X, scale.Y) }),
            "-o" => ParseUpToThreeNumbers(arguments, Vector.Zero, out var offset, out rest)
                && Set(ref texture, texture with { Offset = (offset.X, offset.Y) }),
            "-t" => ParseUpToThreeNumbers(arguments, Vector.Zero, out _, out rest),
            "-bm" => ParseNumber(arguments, out var factor, out rest) && Set(ref texture, texture with { BumpFactor = factor }),
            "-boost" or "-texres" => ParseNumber(arguments, out _, out rest),
            "-mm" => ParseNumber(arguments, out _, out rest) && ParseBlanks(rest, out rest) && ParseNumber(rest, out _, out rest),
            "-imfchan" or "-type" or "-colorspace" => ParseName(arguments, "a word", out _, out rest),
            _ => Fail(cursor, "an option of a texture or a file name"),
        };
    }

    private bool ParseOnOff(Cursor cursor, out bool isOn, out Cursor rest)
    {
        isOn = ParseWord(cursor, "on", out rest);
        return isOn || ParseWord(cursor, "off", out rest);
    }

    /// <summary>
    /// Parses one to three numbers; omitted ones keep their default. A word that merely begins with digits is the name of a file.
    /// </summary>
    private bool ParseUpToThreeNumbers(Cursor cursor, Vector defaults, out Vector numbers, out Cursor rest)
    {
        numbers = defaults;
        if (!ParseNumber(cursor, out var x, out rest))
        {
            return false;
        }

        var (_, y, z) = defaults;
        if (ParseOptionalNumber(rest, ref y, out rest))
        {
            ParseOptionalNumber(rest, ref z, out rest);
        }

        numbers = new(x, y, z);
        return true;
    }

    private bool ParseOptionalNumber(Cursor cursor, ref double number, out Cursor rest)
    {
        rest = cursor;
        ParseBlanks(cursor, out var start);
        if (!NumberReader.TryRead(start.Rest, out _, out var length) || start.Peek(length) is not (' ' or '\t'))
        {
            return false;
        }

        return ParseNumber(start, out number, out rest);
    }
}
