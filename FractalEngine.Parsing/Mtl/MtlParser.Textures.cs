using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Numbers;

namespace FractalEngine.Parsing.Mtl;

/// <content>Parses the statements of textures: options, each with its arguments, then the name of an image file.</content>
public sealed partial class MtlParser
{
    private bool ParseTexture(Cursor statement, Cursor cursor, Func<Material, MaterialTexture, Material> update) =>
        ParseTexture(cursor, out var texture) && UpdateMaterial(statement, material => update(material, texture));

    /// <summary>Parses a texture, and records where its name is.</summary>
    private bool ParseTexture(Cursor cursor, out MaterialTexture texture)
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
        _textureNameOffsets[texture] = rest.Offset;
        return true;
    }

    private bool ParseTextureOption(Cursor cursor, ref MaterialTexture texture, out Cursor rest)
    {
        rest = cursor;
        var length = cursor.Rest.IndexOfAny(" \t\r\n");
        var option = (length < 0 ? cursor.Rest : cursor.Rest[..length]).ToString();
        ParseBlanks(cursor.Advance(option.Length), out var arguments);
        switch (option)
        {
            case "-clamp":
                var isParsed = ParseOnOff(arguments, out var isOn, out rest);
                texture = texture with { IsClamped = isOn };
                return isParsed;
            case "-blendu" or "-blendv" or "-cc":
                return ParseOnOff(arguments, out _, out rest);
            case "-s":
                var isScaleParsed = ParseUpToThreeNumbers(arguments, Vector.One, out var scale, out rest);
                texture = texture with { Scale = (scale.X, scale.Y) };
                return isScaleParsed;
            case "-o":
                var isOffsetParsed = ParseUpToThreeNumbers(arguments, Vector.Zero, out var offset, out rest);
                texture = texture with { Offset = (offset.X, offset.Y) };
                return isOffsetParsed;
            case "-t":
                return ParseUpToThreeNumbers(arguments, Vector.Zero, out _, out rest);
            case "-bm":
                var isFactorParsed = ParseNumber(arguments, out var factor, out rest);
                texture = texture with { BumpFactor = factor };
                return isFactorParsed;
            case "-boost" or "-texres":
                return ParseNumber(arguments, out _, out rest);
            case "-mm":
                return ParseNumber(arguments, out _, out rest) && ParseBlanks(rest, out rest) && ParseNumber(rest, out _, out rest);
            case "-imfchan" or "-type" or "-colorspace":
                return ParseName(arguments, "a word", out _, out rest);
            default:
                return Fail(cursor, "an option of a texture or a file name");
        }
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
