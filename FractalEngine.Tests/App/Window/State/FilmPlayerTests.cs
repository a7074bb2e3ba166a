using FractalEngine.App.Window.State;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Films;

namespace FractalEngine.Tests.App.Window.State;

/// <summary>Tests where a film in a window stands, and which numbers it wants.</summary>
public class FilmPlayerTests
{
    private static readonly Film Numbers = new(2) { Keys = [new NumberKey(0, "a", 1), new NumberKey(2, "a", 3)] };

    [Fact]
    public void Stop_AfterNumbersWereLoaded_WantsThoseOfTheFiles()
    {
        var player = new FilmPlayer(Numbers, Handedness.Left, null);
        Assert.False(player.NeedsLoad);
        player.Seek(1);
        Assert.True(player.NeedsLoad);
        Assert.Equal(1, player.BeginLoad());
        Assert.False(player.NeedsLoad);
        player.Stop();
        Assert.True(player.NeedsLoad);
        Assert.Null(player.BeginLoad());
        Assert.False(player.NeedsLoad);
    }

    [Fact]
    public void Toggle_AtTheEnd_PlaysFromTheBeginning()
    {
        var player = new FilmPlayer(Numbers, Handedness.Left, null);
        player.Seek(9);
        Assert.Equal((2, false), (player.Time, player.IsPlaying));
        player.Toggle();
        Assert.Equal((0, true), (player.Time, player.IsPlaying));
        player.Advance(1.5);
        Assert.Equal((1.5, true), (player.Time, player.IsPlaying));
        player.Advance(0.5);
        Assert.Equal((2, false), (player.Time, player.IsPlaying));
    }

    /// <summary>The window goes on with a film that was edited meanwhile.</summary>
    [Fact]
    public void Player_OfAFilmThatWasMadeShorter_StandsAtItsEnd()
    {
        var player = new FilmPlayer(Numbers, Handedness.Left, null);
        player.Seek(1.5);
        player = new(Numbers with { Duration = 1, Keys = [new NumberKey(0, "a", 1)] }, Handedness.Left, player);
        Assert.Equal(1, player.Time);
    }
}
