using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Numbers;

namespace FractalEngine.Parsing.Wavefront;

/// <summary>Scans the lines of vertices, texture coordinates, normals and faces, each into the arrays of its elements.</summary>
internal abstract class ObjElementScanner : MeshBlockBuilder
{
    private int _requiredPositions;
    private int _requiredTextureCoordinates;
    private int _requiredNormals;

    /// <summary>Numbers of elements that must come before the block, or some index does not exist.</summary>
    public ElementCounts Required => new(_requiredPositions, _requiredTextureCoordinates, _requiredNormals, 0);

    /// <summary>Length of the block.</summary>
    private protected int End { get; private set; }

    /// <summary>Clears all counts, and makes room for the largest number of elements that so many bytes can hold.</summary>
    /// <param name="capacity">
    /// Length of the longest block that is likely to come: arrays that grow copy, and so touch, what no line has written.
    /// </param>
    /// <param name="length">Length of this block.</param>
    private protected void Restart(int capacity, int length)
    {
        // The shortest lines are "v 0 0 0", "vt 0", "vn 0 0 0" and "f 1 1 1" with a line break, the shortest corner " 1".
        Reserve(ref _positions, 3 * ((capacity / 8) + 2));
        Reserve(ref _textureCoordinates, 2 * ((capacity / 5) + 2));
        Reserve(ref _normals, 3 * ((capacity / 9) + 2));
        Reserve(ref _positionIndices, (capacity / 2) + 2);
        Reserve(ref _textureIndices, (capacity / 2) + 2);
        Reserve(ref _normalIndices, (capacity / 2) + 2);
        Reserve(ref _polygonSizes, (capacity / 8) + 2);
        Clear();
        End = length;
        _requiredPositions = _requiredTextureCoordinates = _requiredNormals = 0;
    }

    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private protected nint ScanPosition(ref byte text, nint position)
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
    private protected nint ScanNormal(ref byte text, nint position)
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
    private protected nint ScanTextureCoordinate(ref byte text, nint position)
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
        Span<double> numbers = stackalloc double[VertexColour.MaxNumbers];
        position = ScanOptionalNumbers(ref text, position, numbers, out var count);
        var colour = VertexColour.Find(numbers, count);
        if (position != Utf8NumberReader.None && colour.Length > 0)
        {
            AddColour(colour);
        }

        return position;
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

    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private protected nint ScanFace(ref byte text, nint position)
    {
        ref var indices = ref MemoryMarshal.GetArrayDataReference(_positionIndices);
        var firstCorner = _cornerCount;
        var corner = firstCorner;
        var (textureIndexCount, normalIndexCount) = (_textureIndexCount, _normalIndexCount);
        var (maxPosition, maxTexture, maxNormal) = (0, 0, 0);
        while (true)
        {
            while (IsBlank(Unsafe.Add(ref text, position)))
            {
                position++;
            }

            var next = ScanIndex(ref text, position, _positionCount, ref maxPosition, out Unsafe.Add(ref indices, corner));
            if (next == Utf8NumberReader.None)
            {
                break;
            }

            position = next;
            uint separator = Unsafe.Add(ref text, position);
            if (separator == '/')
            {
                position = ScanOptionalIndices(ref text, position + 1, corner, ref maxTexture, ref maxNormal);
                if (position == Utf8NumberReader.None)
                {
                    break;
                }

                separator = Unsafe.Add(ref text, position);
            }

            corner++;
            if (!IsBlank(separator))
            {
                break;
            }
        }

        var size = corner - firstCorner;
        position = position == Utf8NumberReader.None ? position : ScanEndOfLine(ref text, position);
        if (position == Utf8NumberReader.None || size < 3 || size > ParsingLimits.PolygonCorners.Value)
        {
            (_textureIndexCount, _normalIndexCount) = (textureIndexCount, normalIndexCount);
            return Utf8NumberReader.None;
        }

        _requiredPositions = Math.Max(_requiredPositions, maxPosition - _positionCount);
        _requiredTextureCoordinates = Math.Max(_requiredTextureCoordinates, maxTexture - _textureCoordinateCount);
        _requiredNormals = Math.Max(_requiredNormals, maxNormal - _normalCount);
        AddPolygon(size);
        return position;
    }

    /// <summary>Reads what may follow the first slash of a corner: <c>vt</c>, <c>vt/vn</c> or <c>/vn</c>.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private nint ScanOptionalIndices(ref byte text, nint position, int corner, ref int maxTexture, ref int maxNormal)
    {
        if (Unsafe.Add(ref text, position) != '/')
        {
            FillIndices(_textureIndices, ref _textureIndexCount, corner);
            position = ScanIndex(ref text, position, _textureCoordinateCount, ref maxTexture,
                out Unsafe.Add(ref MemoryMarshal.GetArrayDataReference(_textureIndices), corner));
            if (position == Utf8NumberReader.None)
            {
                return Utf8NumberReader.None;
            }
        }

        if (Unsafe.Add(ref text, position) == '/')
        {
            FillIndices(_normalIndices, ref _normalIndexCount, corner);
            position = ScanIndex(ref text, position + 1, _normalCount, ref maxNormal,
                out Unsafe.Add(ref MemoryMarshal.GetArrayDataReference(_normalIndices), corner));
        }

        return position;
    }

    /// <summary>Reads the number of an element, and returns the position behind it or none.</summary>
    /// <param name="text">Text of the block.</param>
    /// <param name="position">Position of the number.</param>
    /// <param name="count">Number of such elements in the block so far.</param>
    /// <param name="maxNumber">Becomes at least the absolute value of the number.</param>
    /// <param name="index">Receives the index as <see cref="MeshBlock"/> has it.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private nint ScanIndex(ref byte text, nint position, int count, ref int maxNumber, out int index)
    {
        var end = Utf8NumberReader.ReadInteger(ref text, position, out var number);
        index = number - 1;
        if (end == Utf8NumberReader.None && Unsafe.Add(ref text, position) == '-')
        {
            end = Utf8NumberReader.ReadInteger(ref text, position + 1, out number);
            index = MeshBlock.BlockStart + count - number;
            _hasRelativeIndices = true;
        }

        maxNumber = Math.Max(maxNumber, number);
        return number == 0 ? Utf8NumberReader.None : end;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private protected static bool IsBlank(uint character) => character is ' ' or '\t';

    /// <summary>Skips blanks, a comment and a line break, and returns the position of the next line or none.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private nint ScanEndOfLine(ref byte text, nint position) =>
        Unsafe.Add(ref text, position) == '\n' ? position + 1 : ScanUnusualEndOfLine(ref text, position);

    private protected nint ScanUnusualEndOfLine(ref byte text, nint position)
    {
        while (IsBlank(Unsafe.Add(ref text, position)))
        {
            position++;
        }

        return (char)Unsafe.Add(ref text, position) switch
        {
            '\n' => position + 1,
            '\r' => SkipLineBreak(ref text, position),
            '#' => SkipLineBreak(ref text, FindLineBreak(ref text, position)),
            _ => Utf8NumberReader.None,
        };
    }

    private protected nint FindLineBreak(ref byte text, nint position)
    {
        var rest = MemoryMarshal.CreateReadOnlySpan(ref Unsafe.Add(ref text, position), End - (int)position);
        var length = rest.IndexOfAny((byte)'\n', (byte)'\r');
        return length < 0 ? End : position + length;
    }

    private protected static nint SkipLineBreak(ref byte text, nint position) =>
        position + (Unsafe.Add(ref text, position) == '\r' && Unsafe.Add(ref text, position + 1) == '\n' ? 2 : 1);
}
