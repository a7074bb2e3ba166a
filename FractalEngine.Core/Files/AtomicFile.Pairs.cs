namespace FractalEngine.Core.Files;

/// <content>Writes two files that belong together.</content>
public static partial class AtomicFile
{
    /// <summary>Moves a file to its name, and back again if what follows fails.</summary>
    private static void Exchange(string temporary, string target, Action follow)
    {
        var previous = File.Exists(target) ? TemporaryNameFor(target) : null;
        if (previous is not null)
        {
            Temporaries[previous] = true;
            File.Copy(target, previous);
        }

        try
        {
            File.Move(temporary, target, overwrite: true);
            try
            {
                follow();
            }
            catch
            {
                RestorePrevious(previous, target);
                throw;
            }
        }
        finally
        {
            if (previous is not null)
            {
                File.Delete(previous);
                Temporaries.TryRemove(previous, out _);
            }
        }
    }

    private static void RestorePrevious(string? previous, string target)
    {
        if (previous is null)
        {
            File.Delete(target);
        }
        else
        {
            File.Move(previous, target, overwrite: true);
        }
    }
}
