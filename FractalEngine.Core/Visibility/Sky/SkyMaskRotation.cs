namespace FractalEngine.Core.Visibility.Sky;

/// <summary>Takes masks from one frame to another, whose directions lie closest to directions of the first.</summary>
internal sealed class SkyMaskRotation
{
    private const int BitsPerDigit = 4;
    private const int DigitCount = SkyDirections.Count / BitsPerDigit;
    private const int DigitValues = 1 << BitsPerDigit;

    // For each digit of a mask and each of its values, the bits of the other frame that it sets: [16 × 16].
    private readonly ulong[] _table = new ulong[DigitCount * DigitValues];

    /// <summary>Prepares for masks of a frame.</summary>
    /// <param name="sources">For each direction of the frame that masks are taken to, the one of the frame that they come from.</param>
    public SkyMaskRotation(ReadOnlySpan<byte> sources)
    {
        for (var target = 0; target < sources.Length; target++)
        {
            var (digit, bit) = (sources[target] / BitsPerDigit, sources[target] % BitsPerDigit);
            for (var value = 0; value < DigitValues; value++)
            {
                _table[(digit * DigitValues) + value] |= ((value >> bit) & 1) != 0 ? 1ul << target : 0;
            }
        }
    }

    /// <summary>Size of the table in bytes.</summary>
    public int ByteCount => sizeof(ulong) * _table.Length;

    /// <summary>Takes a mask to the other frame.</summary>
    public ulong Apply(ulong mask)
    {
        var turned = 0ul;
        for (var digit = 0; digit < DigitCount; digit++)
        {
            turned |= _table[(digit * DigitValues) + (int)((mask >> (BitsPerDigit * digit)) & (DigitValues - 1))];
        }

        return turned;
    }
}
