using System.Globalization;
using System.IO.MemoryMappedFiles;
using System.Runtime.CompilerServices;

namespace FractalEngineMutants;

/// <summary>
/// Tells the copy under test which of its mutants lives. Compiled into each project of the copy, never into the product.
/// </summary>
/// <remarks>
/// MUTANT names the mutant. MUTANT_FLAGS names a file that all processes of a recording map: a byte a mutant for "reached since the
/// byte was cleared", then a byte for the number of stacks looked at, then a byte for "reached while a static value was computed".
/// </remarks>
internal static unsafe class Mutant
{
    private const byte StacksToLookAt = 5;
    private static readonly int Active =
        int.TryParse(Environment.GetEnvironmentVariable("MUTANT"), CultureInfo.InvariantCulture, out int id) ? id : -1;
    private static readonly byte* Reached = MapFlags(out Count);
    private static readonly int Count;

    /// <summary>Returns whether a mutant lives. The compiler at run time folds this once the class is initialised.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static bool Is(int id)
    {
        if (Reached != null && Reached[id] == 0)
        {
            Note(id);
        }

        return Active == id;
    }

    // At once, so that even methods that are compiled a single time see constants.
#pragma warning disable CA2255
    [ModuleInitializer]
    internal static void Initialise() => RuntimeHelpers.RunClassConstructor(typeof(Mutant).TypeHandle);
#pragma warning restore CA2255

    [MethodImpl(MethodImplOptions.NoInlining)]
    private static void Note(int id)
    {
        Reached[id] = 1;
        byte* stacks = Reached + Count + id;
        if (*stacks < StacksToLookAt)
        {
            (*stacks)++;
            string stack = Environment.StackTrace;
            if (stack.Contains(".cctor", StringComparison.Ordinal) || stack.Contains("System.Lazy`1", StringComparison.Ordinal)
                || stack.Contains(".GetOrAdd", StringComparison.Ordinal))
            {
                Reached[2 * Count + id] = 1;
            }
        }
    }

    private static byte* MapFlags(out int count)
    {
        string? path = Environment.GetEnvironmentVariable("MUTANT_FLAGS");
        count = 0;
        if (path is null)
        {
            return null;
        }

        count = (int)(new FileInfo(path).Length / 3);
        byte* pointer = null;
        MemoryMappedFile.CreateFromFile(path, FileMode.Open).CreateViewAccessor().SafeMemoryMappedViewHandle.AcquirePointer(ref pointer);
        return pointer;
    }
}
