namespace FractalEngine.Core.Files;

/// <summary>Replaces a file so that the one before can come back.</summary>
internal static class FileExchange
{
    /// <summary>Moves a file to its name, and back again if what follows fails.</summary>
    /// <param name="temporary">Full path of the file.</param>
    /// <param name="target">Its name: that of a file which it replaces, or a free one.</param>
    /// <param name="follow">What follows.</param>
    public static void Run(string temporary, string target, Action follow)
    {
        var previous = File.Exists(target) ? TemporaryFiles.NameFor(target) : null;
        if (previous is not null)
        {
            TemporaryFiles.Add(previous);
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
                TemporaryFiles.Delete(previous);
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
