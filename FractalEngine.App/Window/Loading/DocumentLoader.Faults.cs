using FractalEngine.App.Window.State;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Window.Loading;

/// <content>Files that can't be loaded leave the document as it is, and say why.</content>
internal sealed partial class DocumentLoader
{
    // A file that is faulty only because it is still being written is mended sooner.
    private static readonly TimeSpan FaultDelay = TimeSpan.FromSeconds(0.2);

    /// <summary>
    /// Keeps the document, and says why the file can't be loaded: at once, or after a while if the file may be unfinished.
    /// </summary>
    private Redraw Refuse(BackgroundLoad load, string error, TimeSpan now)
    {
        var isReload = Document is not null && load.Path == _path;
        if (Document is null || isReload)
        {
            // What is wrong may be mended in any file that the load has come to, or in one that was fine before.
            _watcher?.Watch(load.Files);
        }

        if (isReload)
        {
            _pendingFault = (error, now + FaultDelay);
            return Redraw.None;
        }

        Console.Error.WriteLine(error);
        if (Document is null)
        {
            overlay.Error = error;
        }
        else
        {
            overlay.ShowProblem(error, now);
        }

        return Redraw.Overlay;
    }

    private Redraw PollFault(RenderSettings settings, TimeSpan now)
    {
        if (_pendingFault is not var (error, time) || now < time)
        {
            return Redraw.None;
        }

        if (_load is not null)
        {
            // What loads now tells more.
            return Redraw.None;
        }

        _pendingFault = null;
        return TryWithoutEdit(error, settings) ? Redraw.None : ShowFault(error);
    }

    private Redraw ShowFault(string error)
    {
        if (overlay.Error != error)
        {
            Console.Error.WriteLine(error);
        }

        overlay.Error = error;
        return Redraw.Overlay;
    }
}
