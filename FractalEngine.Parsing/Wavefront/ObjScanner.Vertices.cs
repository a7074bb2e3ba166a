using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text.Numbers;

namespace FractalEngine.Parsing.Wavefront;

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

        position = Unsafe.Add(ref text, position) == '\n' ? position + 1 : ScanColour(ref text, position);
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

        position = Unsafe.Add(ref text, position) == '\n' ? position + 1 : SkipOptionalNumbers(ref text, position);
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

    /// <summary>Reads what follows a position, and returns the position of the next line or none.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    private nint ScanColour(ref byte text, nint position)
    {
        Span<double> numbers = stackalloc double[ObjColour.MaxNumbers];
        position = ScanOptionalNumbers(ref text, position, numbers, out var count);
        var colour = ObjColour.Find(numbers, count);
        if (position != Utf8NumberReader.None && colour.Length > 0)
        {
            if (_colours.Length < _positions.Length)
            {
                Array.Resize(ref _colours, _positions.Length);
            }

            _colours.AsSpan(3 * _colourCount, 3 * (_positionCount - _colourCount)).Fill(ObjColour.Default);
            colour.CopyTo(_colours.AsSpan(3 * _positionCount));
            _colourCount = _positionCount + 1;
        }

        return position;
    }

    /// <summary>Fills the colours of the vertices behind the last one that has any.</summary>
    private void FillColours()
    {
        if (_colourCount > 0)
        {
            _colours.AsSpan(3 * _colourCount, 3 * (_positionCount - _colourCount)).Fill(ObjColour.Default);
            _colourCount = _positionCount;
        }
    }

    // Kept out of its callers, so that lines without further numbers don't pay for the space on the stack.
    [MethodImpl(MethodImplOptions.NoInlining)]
    private nint SkipOptionalNumbers(ref byte text, nint position) => ScanOptionalNumbers(ref text, position, [0], out _);

    /// <summary>Reads further numbers of a line and its end, and returns the position of the next line or none.</summary>
    /// <param name="text">The block.</param>
    /// <param name="position">Where the numbers begin.</param>
    /// <param name="numbers">Receives the numbers; its last element receives all that have no other place.</param>
    /// <param name="count">How many numbers there are.</param>
    private nint ScanOptionalNumbers(ref byte text, nint position, Span<double> numbers, out int count)
    {
        count = 0;
        while (IsBlank(Unsafe.Add(ref text, position)))
        {
            var next = SkipBlanks(ref text, position);
            if (!IsNumberStart(Unsafe.Add(ref text, next)))
            {
                break;
            }

            position = Utf8NumberReader.Read(ref text, next, ref numbers[Math.Min(count, numbers.Length - 1)]);
            if (position == Utf8NumberReader.None)
            {
                return Utf8NumberReader.None;
            }

            count++;
        }

        return ScanEndOfLine(ref text, position);
    }
}
