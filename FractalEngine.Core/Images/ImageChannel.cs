namespace FractalEngine.Core.Images;

/// <summary>One number for each pixel of an image, under a name.</summary>
/// <param name="Name">What programs find it by: <c>R</c>, or a layer and a component as in <c>albedo.R</c>.</param>
/// <param name="Values">The numbers of all pixels; the top row first; [height × width].</param>
public sealed record ImageChannel(string Name, float[] Values)
{
    /// <summary>Whether a file stores 16 bits of each number instead of 32.</summary>
    public bool IsHalf { get; init; }

    /// <summary>Takes vectors apart into three channels.</summary>
    /// <param name="names">Names of the channels.</param>
    /// <param name="vectors">Components of all pixels; [height × width × 3].</param>
    /// <param name="areHalf">Whether a file stores 16 bits of each number instead of 32.</param>
    public static IEnumerable<ImageChannel> Of(IReadOnlyList<string> names, float[] vectors, bool areHalf)
    {
        ArgumentNullException.ThrowIfNull(names);
        ArgumentNullException.ThrowIfNull(vectors);
        return names.Select((name, component) =>
        {
            var values = new float[vectors.Length / names.Count];
            for (var i = 0; i < values.Length; i++)
            {
                values[i] = vectors[(names.Count * i) + component];
            }

            return new ImageChannel(name, values) { IsHalf = areHalf };
        });
    }
}
