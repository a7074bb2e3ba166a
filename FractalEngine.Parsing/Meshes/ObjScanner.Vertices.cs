using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Meshes;

/// <content>Scans the lines of vertices, texture coordinates and normals.</content>
internal sealed partial class ObjScanner
{
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private nint ScanPosition(ref byte text, nint position)
    {
        ref var target = ref Unsafe.Add(ref MemoryMarshal.GetArrayDataReference(_positions), (nint)3 * _positionCount);
        position = ScanThreeNumbers(ref text, position, ref target);
        if (position == Utf8NumberReader.None)
        {
            return Utf8NumberReader.None;
        }

        position = Unsafe.Add(ref text, position) == '\n' ? position + 1 : ScanOptionalNumbers(ref text, position);
        _positionCount += position == Utf8NumberReader.None ? 0 : 1;
        return position;
    }

    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private nint ScanNormal(ref byte text, nint position)
    {
        ref var target = ref Unsafe.Add(ref MemoryMarshal.GetArrayDataReference(_normals), (nint)3 * _normalCount);
        position = ScanThreeNumbers(ref text, position, ref target);
        if (position == Utf8NumberReader.None)
        {
            return Utf8NumberReader.None;
        }

        position = ScanEndOfLine(ref text, position);
        _normalCount += position == Utf8NumberReader.None ? 0 : 1;
        return position;
    }

    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private nint ScanTextureCoordinate(ref byte text, nint position)
    {
        ref var target = ref Unsafe.Add(ref MemoryMarshal.GetArrayDataReference(_textureCoordinates), (nint)2 * _textureCoordinateCount);
        position = Utf8NumberReader.Read(ref text, SkipBlanks(ref text, position), ref target);
        if (position == Utf8NumberReader.None)
        {
            return Utf8NumberReader.None;
        }

        // A missing second coordinate is 0.
        target = ref Unsafe.Add(ref target, 1);
        target = 0;
        if (IsBlank(Unsafe.Add(ref text, position)) && IsNumberStart(Unsafe.Add(ref text, SkipBlanks(ref text, position))))
        {
            position = Utf8NumberReader.Read(ref text, SkipBlanks(ref text, position), ref target);
            if (position == Utf8NumberReader.None)
            {
                return Utf8NumberReader.None;
            }
        }

        position = Unsafe.Add(ref text, position) == '\n' ? position + 1 : ScanOptionalNumbers(ref text, position);
        _textureCoordinateCount += position == Utf8NumberReader.None ? 0 : 1;
        return position;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static nint ScanThreeNumbers(ref byte text, nint position, ref double target)
    {
        position = Utf8NumberReader.Read(ref text, SkipBlanks(ref text, position), ref target);
        if (position == Utf8NumberReader.None || !IsBlank(Unsafe.Add(ref text, position)))
        {
            return Utf8NumberReader.None;
        }

        position = Utf8NumberReader.Read(ref text, SkipBlanks(ref text, position), ref Unsafe.Add(ref target, 1));
        if (position == Utf8NumberReader.None || !IsBlank(Unsafe.Add(ref text, position)))
        {
            return Utf8NumberReader.None;
        }

        return Utf8NumberReader.Read(ref text, SkipBlanks(ref text, position), ref Unsafe.Add(ref target, 2));
    }

    /// <summary>Skips blanks behind one blank.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static nint SkipBlanks(ref byte text, nint position)
    {
        do
        {
            position++;
        }
        while (IsBlank(Unsafe.Add(ref text, position)));
        return position;
    }

    private static bool IsNumberStart(uint character) => character - '0' <= 9 || character is '-' or '+' or '.';

    /// <summary>Skips further numbers of a line and its end, and returns the position of the next line or none.</summary>
    private nint ScanOptionalNumbers(ref byte text, nint position)
    {
        var ignored = 0.0;
        while (IsBlank(Unsafe.Add(ref text, position)))
        {
            var next = SkipBlanks(ref text, position);
            if (!IsNumberStart(Unsafe.Add(ref text, next)))
            {
                break;
            }

            position = Utf8NumberReader.Read(ref text, next, ref ignored);
            if (position == Utf8NumberReader.None)
            {
                return Utf8NumberReader.None;
            }
        }

        return ScanEndOfLine(ref text, position);
    }
}
