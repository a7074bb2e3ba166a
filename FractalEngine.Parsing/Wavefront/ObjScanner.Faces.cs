using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Numbers;

namespace FractalEngine.Parsing.Wavefront;

/// <content>Scans the lines of faces.</content>
internal sealed partial class ObjScanner
{
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private nint ScanFace(ref byte text, nint position)
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
        if (position == Utf8NumberReader.None || size < 3 || size > ParsingLimits.MaxPolygonCorners)
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

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private void AddPolygon(int size)
    {
        if (size != 3 && !_hasPolygonSizes)
        {
            _polygonSizes.AsSpan(0, _polygonCount).Fill(3);
            _hasPolygonSizes = true;
        }

        if (_hasPolygonSizes)
        {
            _polygonSizes[_polygonCount] = (ushort)size;
        }

        _polygonCount++;
        _cornerCount += size;
        _faceCount += size - 2;
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
    /// <param name="index">Receives the index as <see cref="ObjBlock"/> has it.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private nint ScanIndex(ref byte text, nint position, int count, ref int maxNumber, out int index)
    {
        var end = Utf8NumberReader.ReadInteger(ref text, position, out var number);
        index = number - 1;
        if (end == Utf8NumberReader.None && Unsafe.Add(ref text, position) == '-')
        {
            end = Utf8NumberReader.ReadInteger(ref text, position + 1, out number);
            index = ObjBlock.BlockStart + count - number;
            _hasRelativeIndices = true;
        }

        maxNumber = Math.Max(maxNumber, number);
        return number == 0 ? Utf8NumberReader.None : end;
    }

    /// <summary>Marks the corners before one that has an index as corners without one, and counts that corner.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static void FillIndices(int[] indices, ref int count, int corner)
    {
        if (count != corner)
        {
            indices.AsSpan(count, corner - count).Fill(ObjCorner.None);
        }

        count = corner + 1;
    }

    private void FillIndices(int[] indices, ref int count)
    {
        if (count > 0)
        {
            FillIndices(indices, ref count, _cornerCount);
            count = _cornerCount;
        }
    }
}
