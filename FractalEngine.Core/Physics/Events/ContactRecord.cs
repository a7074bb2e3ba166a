using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Events;

/// <summary>One contact of a step, as it is collected.</summary>
/// <param name="First">Index of the body, the lower one of two.</param>
/// <param name="Second">
/// Index of the other body; for a static object −2 less its index, and <see cref="Unknown"/> until it is found.
/// </param>
/// <param name="Point">World space.</param>
/// <param name="Normal">Unit vector towards the first body.</param>
/// <param name="Impulse">Along the normal.</param>
internal readonly record struct ContactRecord(int First, int Second, Vector Point, Vector Normal, double Impulse)
{
    /// <summary>In place of a surface that is not known yet.</summary>
    public const int Unknown = -1;

    /// <summary>What a static object has for <see cref="Second"/>.</summary>
    public static int OfObject(int index) => -2 - index;

    /// <summary>The order of records: by their bodies, then by what these touch.</summary>
    public static int Compare(ContactRecord record1, ContactRecord record2) => record1.First != record2.First
        ? record1.First.CompareTo(record2.First) : record1.Second.CompareTo(record2.Second);
}
