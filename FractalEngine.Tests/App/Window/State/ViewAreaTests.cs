using FractalEngine.App.Window.State;
using FractalEngine.Render.Ui;

namespace FractalEngine.Tests.App.Window.State;

/// <summary>Tests where the view stands beside the panels.</summary>
public sealed class ViewAreaTests
{
    [Fact]
    public void Update_BeforePanelsAreBuilt_LeavesTheViewInTheMiddle()
    {
        var area = new ViewArea(window: null!);
        Assert.False(area.Update(new(static _ => { })));
        Assert.Equal(0, area.HorizontalShift);
    }

    [Theory]
    [InlineData(UiDock.Left, 1)]
    [InlineData(UiDock.Right, -1)]
    public void Update_WithAPanelAtASide_ShiftsAwayFromItByLessThanHalf(UiDock dock, int sign)
    {
        UiPanel[] panels = [new("Panel", static ui => ui.Label("text")) { Dock = dock, IsOpen = true }];
        var ui = new UserInterface(ui => ui.Panels([.. panels], bottomMargin: 0));
        ui.Update(900, 600);
        var area = new ViewArea(window: null!);
        Assert.True(area.Update(ui));
        Assert.InRange(sign * area.HorizontalShift, 0.01, 0.49);
        Assert.False(area.Update(ui));
    }
}
